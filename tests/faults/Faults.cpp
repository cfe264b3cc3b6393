// For LD_PRELOAD, by scripts/inject-faults. With HAGEN_FAULTS=server, a program stops at the start
// of main() and reads lines from its standard input:
//     FOLDER <tab> STANDARD OUTPUT <tab> STANDARD ERROR <tab> FAULT
// Each is a run of the program in a process of its own, forked from there: loading its libraries
// takes longer than a small conversion. The server answers with the process, and when that has
// ended, with its status as of wait(). The fault:
//     stop   the process stops itself, until strace is attached
//     new N  the N-th allocation by `new`, counted from there, fails once; 0: none does, and their
//            number is printed at the end. malloc() is left alone: libraries in C say what they do
//            without memory.
//     none
// Programs that the process starts have the same allocation fail, by HAGEN_FAILING_NEW.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <sstream>
#include <string>

namespace {

using Main = int (*)(int, char**, char**);
using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

std::atomic<bool> is_in_main{false};
std::atomic<long> allocations{0};
long failing = 0;
Main program = nullptr;

/// Ends the process if it fails: the server has said nothing about it then.
void require(bool holds) {
    if (!holds) _exit(99);
}

void redirect(const std::string& file, int flags, int descriptor) {
    const int opened = open(file.c_str(), flags | O_CLOEXEC, 0600);
    require(opened >= 0 && dup2(opened, descriptor) == descriptor);
    close(opened);
}

/// Reads a line byte by byte: what follows must stay in the pipe. Empty at the end.
std::string readLine() {
    std::string line;
    for (char next = 0; read(STDIN_FILENO, &next, 1) == 1 && next != '\n';) line += next;
    return line;
}

/// Prepares a run in a process that was forked for it.
void begin(std::istringstream words) {
    std::string folder, out, err, fault;
    for (std::string* word : {&folder, &out, &err}) std::getline(words, *word, '\t');
    std::getline(words, fault);
    setsid();
    require(chdir(folder.c_str()) == 0);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    unsetenv("HAGEN_FAULTS");
    if (fault == "stop") raise(SIGSTOP);
    if (fault.rfind("new ", 0) == 0) setenv("HAGEN_FAILING_NEW", fault.c_str() + 4, 1);
}

/// Returns in each process that is to run the program; the server ends here.
void serve() {
    for (std::string line; !(line = readLine()).empty();) {
        const pid_t process = fork();
        if (process == 0) return begin(std::istringstream(line));
        dprintf(STDOUT_FILENO, "%d\n", process);
        int status = 0;
        while (waitpid(process, &status, 0) < 0) {
        }
        dprintf(STDOUT_FILENO, "%d\n", status);
    }
    _exit(0);
}

int countedMain(int argc, char** argv, char** environment) {
    if (std::getenv("HAGEN_FAULTS") != nullptr) serve();
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
    if (is_in_main && ++allocations == failing) throw std::bad_alloc();
    // aligned_alloc() wants a multiple of the alignment.
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

/// Of the C library, which calls main().
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
    program = main;
    const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(countedMain, argc, argv, init, fini, rtld_fini, stack_end);
}
