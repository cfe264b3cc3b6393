#pragma once
#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace hagen::python {

/// Releases the GIL during its lifetime, like pybind11::gil_scoped_release. If Python exits
/// meanwhile, it ends (daemon) threads that request the GIL by unwinding their stacks. Destructors
/// would then use Python without the GIL, and pybind11's would abort() the process. Such a thread
/// therefore blocks in the destructor until the process ends, as in Python 3.14.
class GilRelease {
 public:
    GilRelease() : thread_(PyEval_SaveThread()) {}
    ~GilRelease() {
        try {
            PyEval_RestoreThread(thread_);
        } catch (const abi::__forced_unwind&) {
            while (true) pause();
        }
    }
    GilRelease(const GilRelease&) = delete;
    GilRelease& operator=(const GilRelease&) = delete;

 private:
    PyThreadState* thread_;
};

}  // namespace hagen::python
