#pragma once
#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace hagen::python {

/// Releases the GIL while it lives, as pybind11::gil_scoped_release. Where Python ends meanwhile,
/// it ends the threads that want the GIL back (daemon threads), by unwinding their stacks:
/// destructors on it would use Python without the GIL, and pybind11's ends the process by abort().
/// So such a thread stays here until the process is gone, as from Python 3.14 on.
class OthersRun {
 public:
    OthersRun() : thread_(PyEval_SaveThread()) {}
    ~OthersRun() {
        try {
            PyEval_RestoreThread(thread_);
        } catch (const abi::__forced_unwind&) {
            while (true) pause();
        }
    }
    OthersRun(const OthersRun&) = delete;
    OthersRun& operator=(const OthersRun&) = delete;

 private:
    PyThreadState* thread_;
};

}  // namespace hagen::python
