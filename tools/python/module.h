#pragma once
// The parts of the Python module talus._core, on which the package talus is built (talus/*.py beside this
// file).

#include <pybind11/pybind11.h>

namespace talus::python {

void addScenarios(pybind11::module_& module);   ///< Scenario, read, parse
void addAnalyses(pybind11::module_& module);    ///< search, limit_analysis, run, batch
void addFailureMap(pybind11::module_& module);  ///< failure_map
void addKinematics(pybind11::module_& module);  ///< kinematics
void addReport(pybind11::module_& module);      ///< report
void addSimulation(pybind11::module_& module);  ///< Simulation
void addSnapshots(pybind11::module_& module);   ///< Snapshots

}  // namespace talus::python
