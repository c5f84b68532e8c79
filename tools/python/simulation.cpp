// A time history that Python takes step by step, with its blocks as numpy arrays.

#include <pybind11/stl.h>

#include <atomic>
#include <memory>
#include <optional>

#include "cli/scenario.h"
#include "cli/text.h"
#include "python/arrays.h"
#include "python/computing.h"
#include "python/module.h"
#include "talus/contact_table.h"
#include "talus/simulation.h"

namespace talus::python {

py::dict contactArrays(const FullFrame& frame) {
    ContactTable table = contactTable(frame);
    std::vector<std::uint8_t> state;
    for (const PointState each : table.state) state.push_back(static_cast<std::uint8_t>(each));
    py::dict arrays;
    arrays["position"] = vectorArray(table.position);
    arrays["normal"] = vectorArray(table.normal);
    arrays["gap"] = ownedArray(std::move(table.gap));
    arrays["force"] = vectorArray(table.force);
    arrays["shear"] = vectorArray(table.shear);
    arrays["normal_force"] = ownedArray(std::move(table.normal_force));
    arrays["water_force"] = ownedArray(std::move(table.water_force));
    arrays["mobilised"] = ownedArray(std::move(table.mobilised));
    arrays["area"] = ownedArray(std::move(table.area));
    arrays["state"] = ownedArray(std::move(state));
    arrays["interface"] = ownedArray(std::move(table.interface));
    arrays["block_a"] = ownedArray(std::move(table.block_a));
    arrays["block_b"] = ownedArray(std::move(table.block_b));
    arrays["joint"] = ownedArray(std::move(table.joint));
    return arrays;
}

namespace {

constexpr py::ssize_t kDouble = sizeof(double);

/// A simulation with positions and velocities as arrays of three, updated after every call that steps. Their
/// memory stays in place, so arrays given to Python follow.
class SteppedModel {
 public:
    SteppedModel(const formats::Scenario& scenario, const py::object& threads, const py::object& progress)
        : scenario_(std::make_shared<formats::Scenario>(scenario)), threads_(threadsOf(threads)) {
        compute({threads_, progress}, [&](Computing& computing) {
            const std::shared_ptr<const Model> model(scenario_, &scenario_->model);
            simulation_.emplace(tools::valueOf(Simulation::begin(model, computing.control()), *scenario_));
        });
        for (std::vector<double>* values : {&positions_, &velocities_}) values->resize(3 * blocks());
        refresh();
    }

    void step(std::int64_t count, const py::object& progress) {
        if (count < 0) throw py::value_error("count must not be negative");
        const Use alone(busy_);
        compute({threads_, progress}, [&](Computing& computing) {
            const std::vector<Error> errors = simulation_->step(count, computing.control());
            refresh();
            if (!errors.empty()) throw tools::BadInput(formats::placed(*scenario_, errors));
        });
    }

    /// Access to more than the arrays, which keep the values of the last step.
    template <class Look>
    auto look(const Look& what) const {
        const Use alone(busy_);
        const py::gil_scoped_release others_may;
        return what(*simulation_);
    }

    const Simulation& simulation() const { return *simulation_; }
    std::size_t blocks() const { return simulation_->blocks().size; }
    const double* positions() const { return positions_.data(); }
    const double* velocities() const { return velocities_.data(); }

 private:
    /// One thread at a time: Python's lock is not held while steps are computed.
    class Use {
     public:
        explicit Use(std::atomic<bool>& busy) : busy_(busy) {
            if (busy_.exchange(true))
                throw std::runtime_error("another thread is computing with this Simulation");
        }
        ~Use() { busy_ = false; }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;

     private:
        std::atomic<bool>& busy_;
    };

    void refresh() {
        const BlockView view = simulation_->blocks();
        for (std::size_t b = 0; b < view.size; ++b)
            for (std::size_t i = 0; i < 3; ++i) {
                positions_[3 * b + i] = view.origin[static_cast<Eigen::Index>(i)] + view.position[4 * b + i];
                velocities_[3 * b + i] = view.velocity[i][b];
            }
    }

    std::shared_ptr<const formats::Scenario> scenario_;  // the model's home
    int threads_;
    mutable std::atomic<bool> busy_{false};
    std::optional<Simulation> simulation_;
    std::vector<double> positions_, velocities_;
};

py::array_t<double> threes(const py::object& self, const double* values) {
    const auto n = static_cast<py::ssize_t>(self.cast<SteppedModel&>().blocks());
    return lentArray(values, {n, 3}, {3 * kDouble, kDouble}, self);
}

py::array_t<double> quaternions(const py::object& self) {
    const BlockView view = self.cast<SteppedModel&>().simulation().blocks();
    return lentArray(view.quaternion, {static_cast<py::ssize_t>(view.size), 4}, {4 * kDouble, kDouble}, self);
}

py::tuple energies(const SteppedModel& self) {
    const HistoryRecord now = self.look([](const Simulation& s) { return s.record(); });
    return py::make_tuple(now.kinetic_energy, now.elastic_energy, now.gravity_energy, now.out_of_balance);
}

}  // namespace

void addSimulation(py::module_& module) {
    py::class_<SteppedModel>(module, "Simulation")
        .def(py::init<const formats::Scenario&, py::object, py::object>(), py::arg("scenario"),
             py::arg("threads"), py::arg("progress"))
        .def("step", &SteppedModel::step, py::arg("count"), py::arg("progress"))
        .def_property_readonly(
            "positions",
            [](const py::object& self) { return threes(self, self.cast<SteppedModel&>().positions()); })
        .def_property_readonly(
            "velocities",
            [](const py::object& self) { return threes(self, self.cast<SteppedModel&>().velocities()); })
        .def_property_readonly("quaternions", quaternions)
        .def("contacts",
             [](const SteppedModel& self) {
                 return contactArrays(self.look([](const Simulation& s) { return s.frame(); }));
             })
        .def("energies", energies)
        .def_property_readonly("time", [](const SteppedModel& self) { return self.simulation().time(); })
        .def_property_readonly("steps", [](const SteppedModel& self) { return self.simulation().steps(); })
        .def_property_readonly("time_step", [](const SteppedModel& s) { return s.simulation().timeStep(); })
        .def_property_readonly(
            "start",
            [](const SteppedModel& s) { return std::string(toString(s.simulation().startedFrom())); })
        .def_property_readonly("state_hash", [](const SteppedModel& self) {
            return tools::hashText(self.look([](const Simulation& s) { return s.stateHash(); }));
        });
}

}  // namespace talus::python
