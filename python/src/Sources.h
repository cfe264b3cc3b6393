#pragma once
#include <pybind11/pybind11.h>

namespace hagen::python {

/// Defines Recording, Simulation and scenarios(). Two implementations: with_mrpt/ and captures/.
void defineSources(pybind11::module_& m);

}  // namespace hagen::python
