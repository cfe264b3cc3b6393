/// Replaces MRPT's allocation for cloud vectors, which returns an unchecked null pointer if memory
/// is exhausted (mrpt/core/aligned_allocator.h), with an allocation that throws std::bad_alloc.
#include <mrpt/core/aligned_allocator.h>

#include <cstdlib>
#include <cstring>
#include <new>

// Makes the functions visible even in a Python module with hidden symbols.
#define HAGEN_VISIBLE __attribute__((visibility("default")))

namespace mrpt {

HAGEN_VISIBLE void* aligned_malloc(std::size_t size, std::size_t alignment) {
    void* memory = nullptr;
    // Some systems support neither 0-byte blocks nor alignments below pointer size.
    if (posix_memalign(&memory, alignment < sizeof(void*) ? sizeof(void*) : alignment,
                       size == 0 ? 1 : size) != 0) {
        throw std::bad_alloc();
    }
    return memory;
}

HAGEN_VISIBLE void* aligned_calloc(std::size_t bytes, std::size_t alignment) {
    return std::memset(aligned_malloc(bytes, alignment), 0, bytes);
}

HAGEN_VISIBLE void aligned_free(void* ptr) { std::free(ptr); }

}  // namespace mrpt
