#pragma once
// Blocks put together to one body.

#include <vector>

#include "block_theory/closures.h"
#include "block_theory/groups.h"

namespace talus::keyblocks {

/// One for each thread: it has arrays as long as the slope.
class BodyMaker {
 public:
    BodyMaker(const Slope& slope, const std::vector<Joint>& joints)
        : slope_(slope), joints_(joints), inside_(slope.size()) {}

    /// As one body against all others, held still.
    Group groupOf(const std::vector<std::size_t>& members);
    /// The same with planes and joints.
    Sliding detailsOf(const std::vector<std::size_t>& members);
    /// Free blocks that touch it, each once. \param members  as of the last call of one of the two above
    std::vector<std::size_t> neighboursOf(const std::vector<std::size_t>& members);

    static std::uint64_t identityOf(const std::vector<std::size_t>& members);

 private:
    Body bodyOf(const std::vector<std::size_t>& members);

    const Slope& slope_;
    const std::vector<Joint>& joints_;
    Marks inside_;
    std::vector<Contact> outer_{};
};

}  // namespace talus::keyblocks
