#pragma once
#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

namespace hagen::python {

/// Releases the GIL during its lifetime, like pybind11::gil_scoped_release. If Python exits
/// meanwhile, it ends (daemon) threads that request the GIL by unwinding their stacks: destructors
/// would use Python without the GIL, and pybind11's would abort() the process. Such a thread
/// therefore blocks here until the process ends, as in Python 3.14.
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
