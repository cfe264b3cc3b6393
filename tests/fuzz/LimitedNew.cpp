// As in the process of RawlogTrial.cpp, `new` throws std::bad_alloc beyond a limit. The address
// sanitizer does not support memory limits.
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kMax = std::size_t{1} << 28;  // total of live allocations

std::atomic<std::size_t> allocated{0};

void* take(std::size_t bytes) noexcept {
    if (bytes > kMax || allocated > kMax) return nullptr;
    void* const memory = std::malloc(bytes > 0 ? bytes : 1);
    if (memory != nullptr) allocated += malloc_usable_size(memory);
    return memory;
}

void* takeOrThrow(std::size_t bytes) {
    void* const memory = take(bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void giveBack(void* memory) noexcept {
    if (memory != nullptr) allocated -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t bytes) { return takeOrThrow(bytes); }
void* operator new[](std::size_t bytes) { return takeOrThrow(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return take(bytes); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return take(bytes); }
void operator delete(void* memory) noexcept { giveBack(memory); }
void operator delete[](void* memory) noexcept { giveBack(memory); }
void operator delete(void* memory, std::size_t) noexcept { giveBack(memory); }
void operator delete[](void* memory, std::size_t) noexcept { giveBack(memory); }
