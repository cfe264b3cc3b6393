// Preloaded (LD_PRELOAD) by faults_test.py. With HAGEN_FAILING_NEW=N, the N-th allocation by `new`
// since the start of main(), even in child processes, fails once and prints its call stack. With 0,
// no allocation fails, and their number is printed at the end. malloc() is not affected, because C
// libraries report its failure.
#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

using Main = int (*)(int, char**, char**);
using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

std::atomic<bool> is_in_main{false};
std::atomic<long> allocations{0};
long failing = 0;
Main program = nullptr;

int countedMain(int argc, char** argv, char** environment) {
    const char* const wanted = std::getenv("HAGEN_FAILING_NEW");
    failing = wanted != nullptr ? std::atol(wanted) : 0;
    is_in_main = wanted != nullptr;
    const int exit_code = program(argc, argv, environment);
    is_in_main = false;
    if (wanted != nullptr && failing == 0) {
        std::fprintf(stderr, "allocations: %ld\n", allocations.load());
    }
    return exit_code;
}

void* allocated(std::size_t size, std::size_t alignment) {
    if (is_in_main && ++allocations == failing) {
        void* frames[64];
        backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
        throw std::bad_alloc();
    }
    // aligned_alloc() requires a multiple of the alignment.
    void* const memory = std::aligned_alloc(
        alignment, (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocated(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new[](std::size_t size) { return allocated(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocated(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocated(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

/// The C library function that calls main().
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
    program = main;
    const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(countedMain, argc, argv, init, fini, rtld_fini, stack_end);
}
