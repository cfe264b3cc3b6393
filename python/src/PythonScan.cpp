#include "PythonScan.h"

#include "Arrays.h"

namespace hagen::python {

void copyReturns(const Scan& returns, PythonScan& scan) {
    namespace py = pybind11;
    scan.xyz = pointsOf(returns);
    scan.intensity = copied(returns.intensity);
    scan.ring = scan.sensor.has_rings ? py::object(copied(returns.row)) : py::none();
    scan.times = returns.time_s.empty() ? py::none() : py::object(copied(returns.time_s));
}

}  // namespace hagen::python
