#pragma once
// Little-endian fields of MCAP records, appended to and taken from byte strings.

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace talus::mcap {

using Bytes = std::vector<std::uint8_t>;

/// A view of bytes owned elsewhere.
struct View {
    const std::uint8_t* data = nullptr;
    std::size_t size = 0;

    View() = default;
    View(const std::uint8_t* begin, std::size_t length) : data(begin), size(length) {}
    View(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}
    View from(std::size_t offset) const { return {data + offset, size - offset}; }
};

/// Appends fields to a byte string.
class Encoder {
 public:
    explicit Encoder(Bytes& out) : out_(out) {}

    template <class Integer>
    void integer(Integer value) {
        for (std::size_t k = 0; k < sizeof(Integer); ++k)
            out_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * k)));
    }
    void raw(View bytes) { out_.insert(out_.end(), bytes.data, bytes.data + bytes.size); }
    void text(std::string_view value) {
        integer(static_cast<std::uint32_t>(value.size()));
        out_.insert(out_.end(), value.begin(), value.end());
    }

 private:
    Bytes& out_;
};

/// Takes fields from a byte string. Once something does not fit, everything that follows is zero or empty and
/// ok() is false.
class Decoder {
 public:
    explicit Decoder(View in) : in_(in) {}

    bool ok() const { return ok_; }
    bool empty() const { return at_ == in_.size; }
    std::size_t at() const { return at_; }
    std::size_t left() const { return in_.size - at_; }

    template <class Integer>
    Integer integer() {
        const View bytes = raw(sizeof(Integer));
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < bytes.size; ++k) value |= std::uint64_t{bytes.data[k]} << (8 * k);
        return static_cast<Integer>(value);
    }
    View raw(std::uint64_t size) {
        if (!ok_ || size > left()) {
            ok_ = false;
            return {};
        }
        const View bytes{in_.data + at_, static_cast<std::size_t>(size)};
        at_ += bytes.size;
        return bytes;
    }
    std::string text() {
        const View bytes = raw(integer<std::uint32_t>());
        return {reinterpret_cast<const char*>(bytes.data), bytes.size};
    }

 private:
    View in_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

}  // namespace talus::mcap
