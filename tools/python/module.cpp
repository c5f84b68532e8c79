// talus._core: the C++ part of the package talus. Results cross as the JSON of the command line, arrays as
// numpy's.

#include "python/module.h"

#include "cli/failures.h"
#include "cli/provenance.h"
#include "talus/build_info.h"

namespace talus::python {

namespace py = pybind11;

namespace {

/// [(file, line, column, field, message)], None where nothing is known.
py::list errorTuples(const std::vector<Error>& errors) {
    py::list list;
    for (const Error& error : errors)
        list.append(py::make_tuple(error.file.empty() ? py::object(py::none()) : py::str(error.file),
                                   error.line > 0 ? py::object(py::int_(error.line)) : py::none(),
                                   error.column > 0 ? py::object(py::int_(error.column)) : py::none(),
                                   error.field, error.message));
    return list;
}

/// BadInput becomes talus.ScenarioError, FileRefused OSError.
void translate(std::exception_ptr thrown) {
    try {
        std::rethrow_exception(thrown);
    } catch (const tools::BadInput& bad) {
        const py::object type = py::module_::import("talus._errors").attr("ScenarioError");
        PyErr_SetObject(type.ptr(), type(errorTuples(bad.errors)).ptr());
    } catch (const tools::FileRefused& refused) {
        PyErr_SetString(PyExc_OSError, refused.what());
    }
}

}  // namespace

}  // namespace talus::python

PYBIND11_MODULE(_core, module) {
    using namespace talus::python;
    const talus::BuildInfo& build = talus::buildInfo();
    module.doc() = "Talus's engine, formats and command line; use the package talus.";
    module.attr("version") = build.version;
    module.attr("git_hash") = build.git_hash;
    talus::tools::rememberCaller("import talus");
    py::register_exception_translator(translate);
    addScenarios(module);
    addAnalyses(module);
    addFailureMap(module);
    addKinematics(module);
    addReport(module);
    addSimulation(module);
    addSnapshots(module);
}
