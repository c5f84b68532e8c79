#pragma once
// How long tests may take.

namespace talus::test {

/// How many times longer the program may take where it is built with sanitizers and assertions: what a test
/// waits for, and how long.
inline constexpr double kSlower = TALUS_SLOWER;

/// There a test that takes minutes tries a few of its cases: what sanitizers see is in each of them.
inline constexpr bool kTriesFew = kSlower > 1;

}  // namespace talus::test
