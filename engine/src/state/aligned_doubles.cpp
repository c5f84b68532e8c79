#include "state/aligned_doubles.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace talus {
namespace {

constexpr std::size_t kLine = 64;         // bytes
constexpr std::size_t kHuge = 1UL << 21;  // bytes; from here on whole pages

std::size_t roundedUp(std::size_t bytes) {
    const std::size_t unit = bytes < kHuge ? kLine : kHuge;
    return (bytes + unit - 1) / unit * unit;
}

#ifdef __linux__
double* mapped(void* at) {
    if (at == MAP_FAILED) throw std::bad_alloc();
    return static_cast<double*>(at);
}
#endif

/// \pre bytes is rounded up
double* allocate(std::size_t bytes) {
#ifdef __linux__
    if (bytes >= kHuge) {
        double* at = mapped(mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        madvise(at, bytes, MADV_HUGEPAGE);  // a hint only
        return at;
    }
#endif
    void* at = std::aligned_alloc(kLine, bytes);
    if (at == nullptr) throw std::bad_alloc();
    return static_cast<double*>(at);
}

void release(double* at, std::size_t bytes) {
#ifdef __linux__
    if (bytes >= kHuge) {
        munmap(at, bytes);
        return;
    }
#endif
    std::free(at);
}

}  // namespace

AlignedDoubles::AlignedDoubles(const AlignedDoubles& other) { *this = other; }

AlignedDoubles::AlignedDoubles(AlignedDoubles&& other) noexcept { *this = std::move(other); }

AlignedDoubles& AlignedDoubles::operator=(const AlignedDoubles& other) {
    if (this == &other) return *this;
    if (capacity_ < other.size_) {
        size_ = 0;
        reserve(other.size_);
    }
    size_ = other.size_;
    if (size_ > 0) std::memcpy(data_, other.data_, size_ * sizeof(double));
    return *this;
}

AlignedDoubles& AlignedDoubles::operator=(AlignedDoubles&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
}

AlignedDoubles::~AlignedDoubles() {
    if (data_ != nullptr) release(data_, capacity_ * sizeof(double));
}

void AlignedDoubles::reserve(std::size_t capacity) {
    const std::size_t before = capacity_ * sizeof(double), bytes = roundedUp(capacity * sizeof(double));
#ifdef __linux__
    if (before >= kHuge) {
        data_ = mapped(mremap(data_, before, bytes, MREMAP_MAYMOVE));
        capacity_ = bytes / sizeof(double);
        return;
    }
#endif
    double* larger = allocate(bytes);
    if (size_ > 0) std::memcpy(larger, data_, size_ * sizeof(double));
    if (data_ != nullptr) release(data_, before);
    data_ = larger;
    capacity_ = bytes / sizeof(double);
}

void AlignedDoubles::grow(std::size_t size) {
    if (size > capacity_) reserve(std::max(size, capacity_ + capacity_ / 2));
    if (size > size_) std::memset(data_ + size_, 0, (size - size_) * sizeof(double));
    size_ = size;
}

bool operator==(const AlignedDoubles& a, const AlignedDoubles& b) {
    return std::equal(a.data_, a.data_ + a.size_, b.data_, b.data_ + b.size_);
}

}  // namespace talus
