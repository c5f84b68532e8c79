#pragma once
// A growing array of doubles for the big arrays of a state. Unlike a std::vector it begins on a cache line,
// so that a register of eight is one line. It requests huge pages, so that streams of large models do not
// wait for page tables. It grows by moving pages, so it never needs twice its own memory.

#include <cstddef>

namespace talus {

class AlignedDoubles {
 public:
    AlignedDoubles() = default;
    AlignedDoubles(const AlignedDoubles& other);
    AlignedDoubles(AlignedDoubles&& other) noexcept;
    AlignedDoubles& operator=(const AlignedDoubles& other);
    AlignedDoubles& operator=(AlignedDoubles&& other) noexcept;
    ~AlignedDoubles();

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const double* data() const { return data_; }
    double* data() { return data_; }
    double operator[](std::size_t i) const { return data_[i]; }
    double& operator[](std::size_t i) { return data_[i]; }

    /// The new ones are zero. \pre size >= size(). Throws std::bad_alloc.
    void grow(std::size_t size);

    friend bool operator==(const AlignedDoubles& a, const AlignedDoubles& b);

 private:
    void reserve(std::size_t capacity);

    double* data_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace talus
