#pragma once
// Functions of one variable as tables of pieces, four numbers each. The leading bits of the variable select a
// piece, 64 to a power of two. The same steps for one number here and for several in lanes.h.
//
// A table has kPieces pieces: below 1, from 1 to kGreatest, and beyond. A piece is valid up to its fourth
// number. Between that and the next piece, the value is sought in the extra pieces at the end, the last of
// which has no end.

#include <cstring>

#include "simd/scalar.h"

namespace talus::simd {

template <class V>
struct FourOf {
    V number[4];
};

/// A table for each lane.
template <class V>
struct TablesOf {
    const double* at = nullptr;
};

inline constexpr int kOctaves = 40, kPiecesPerOctave = 64;
inline constexpr std::uint64_t kPieces = 2 + kOctaves * kPiecesPerOctave;
inline constexpr double kGreatest = 0x1p40;                                // where the last piece begins
inline constexpr double kLeast = 1.0 - 1.0 / (2 * kPiecesPerOctave);       // anything in the first piece
inline constexpr int kPieceShift = 52 - 6;                                 // leaves exponent and six bits
inline constexpr std::uint64_t kFirstPiece = 1023 * kPiecesPerOctave - 1;  // the bits of kLeast

TALUS_KERNEL const double* pieceFor(const double* table, double x) {
    const double inside = larger(smaller(x, kGreatest), kLeast);
    std::uint64_t bits;
    std::memcpy(&bits, &inside, sizeof bits);
    const double* piece = table + 4 * ((bits >> kPieceShift) - kFirstPiece);
    if (x > piece[3])
        for (piece = table + 4 * kPieces; x > piece[3];) piece += 4;
    return piece;
}

TALUS_KERNEL FourOf<double> pieceAt(const TablesOf<double>& tables, double x) {
    const double* piece = pieceFor(tables.at, x);
    return {{piece[0], piece[1], piece[2], piece[3]}};
}

}  // namespace talus::simd
