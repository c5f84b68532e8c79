#include "mcap/compression.h"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <memory>

namespace talus::mcap {
namespace {

constexpr int kLevel = 1;  // doubles hardly shrink further at higher levels, which take several times as long

// Coordinates shrink by some ten per cent, and unmoved blocks to nothing: a frame of a million of them is 36
// MB of zeros. A larger claim was made to exhaust the memory.
constexpr std::uint64_t kMostOfLittle = std::uint64_t{64} << 20;  // [bytes]
constexpr std::uint64_t kMostRatio = 1024;

bool isPlausible(View bytes, std::uint64_t size) { return size <= kMostOfLittle + kMostRatio * bytes.size; }

/// Agrees with the frame's own head; a head without a size is accepted until its bytes come.
bool headAgrees(View bytes, std::uint64_t size) {
    const unsigned long long said = ZSTD_getFrameContentSize(bytes.data, bytes.size);
    return said == ZSTD_CONTENTSIZE_UNKNOWN || said == size;
}

bool decompressZstd(View bytes, std::uint64_t size, Bytes& out) {
    const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
    if (!context || !isPlausible(bytes, size) || !headAgrees(bytes, size)) return false;
    ZSTD_inBuffer in{bytes.data, bytes.size, 0};
    const std::size_t step = ZSTD_DStreamOutSize();
    std::size_t done = 0, left = 1;
    // Grows with what comes out, so that a false size in a damaged file costs nothing.
    while (left != 0) {
        out.resize(std::min<std::uint64_t>(size, done + step) + (done >= size ? 1 : 0));
        ZSTD_outBuffer target{out.data(), out.size(), done};
        left = ZSTD_decompressStream(context.get(), &target, &in);
        if (ZSTD_isError(left) || target.pos > size) return false;
        if (target.pos == done && in.pos == in.size && left != 0) return false;
        done = target.pos;
    }
    out.resize(done);
    return done == size && in.pos == in.size;
}

}  // namespace

std::uint32_t crc32(std::uint32_t crc, View bytes) {
    if (bytes.size == 0) return crc;  // zlib starts anew at a null pointer
    return static_cast<std::uint32_t>(::crc32_z(crc, bytes.data, bytes.size));
}

Bytes compress(View bytes) {
    Bytes out(ZSTD_compressBound(bytes.size));
    const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data, bytes.size, kLevel);
    if (ZSTD_isError(size)) return {};
    out.resize(size);
    return out;
}

bool decompress(const std::string& compression, View bytes, std::uint64_t size, Bytes& out) {
    out.clear();
    if (compression == "zstd") return decompressZstd(bytes, size, out);
    if (!compression.empty() || bytes.size != size) return false;
    out.assign(bytes.data, bytes.data + bytes.size);
    return true;
}

}  // namespace talus::mcap
