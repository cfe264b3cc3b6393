#include "support/Allocations.h"

#include <atomic>
#include <cerrno>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define HAGEN_COUNTS_ALLOCATIONS 0
#else
#define HAGEN_COUNTS_ALLOCATIONS 1
#endif

namespace hagen {
namespace {

std::atomic<std::size_t> count{0};

}  // namespace

std::size_t allocations() { return count.load(std::memory_order_relaxed); }
bool countsAllocations() { return HAGEN_COUNTS_ALLOCATIONS != 0; }

}  // namespace hagen

#if HAGEN_COUNTS_ALLOCATIONS
// glibc lets programs replace these functions, and exports the originals under these names.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
    hagen::count.fetch_add(1, std::memory_order_relaxed);
    return __libc_malloc(size);
}
void* calloc(std::size_t entries, std::size_t size) noexcept {
    hagen::count.fetch_add(1, std::memory_order_relaxed);
    return __libc_calloc(entries, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
    hagen::count.fetch_add(1, std::memory_order_relaxed);
    return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
    hagen::count.fetch_add(1, std::memory_order_relaxed);
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
    hagen::count.fetch_add(1, std::memory_order_relaxed);
    *memory = __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
}
#endif
