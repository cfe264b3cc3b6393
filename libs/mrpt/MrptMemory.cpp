/// MRPT's allocation for the vectors of its clouds, which it does not check: where there is no
/// memory, it returns a null pointer, through which the vector writes (mrpt/core/
/// aligned_allocator.h). These definitions take the place of MRPT's in every program that links
/// them, so that the vector throws std::bad_alloc as others do.
#include <mrpt/core/aligned_allocator.h>

#include <cstdlib>
#include <cstring>
#include <new>

// Also in a Python module, whose symbols are hidden.
#define HAGEN_SEEN __attribute__((visibility("default")))

namespace mrpt {

HAGEN_SEEN void* aligned_malloc(std::size_t size, std::size_t alignment) {
    void* memory = nullptr;
    // Some systems have no block of 0 bytes, and none that is aligned to less than a pointer.
    if (posix_memalign(&memory, alignment < sizeof(void*) ? sizeof(void*) : alignment,
                       size == 0 ? 1 : size) != 0) {
        throw std::bad_alloc();
    }
    return memory;
}

HAGEN_SEEN void* aligned_calloc(std::size_t bytes, std::size_t alignment) {
    return std::memset(aligned_malloc(bytes, alignment), 0, bytes);
}

HAGEN_SEEN void aligned_free(void* ptr) { std::free(ptr); }

}  // namespace mrpt
