#pragma once
// Where to probe next. Loads are whole numbers of cells, each as wide as the answer's bracket may be; the search ends
// when one cell is left, so the bracket found does not depend on the way that led to it.

#include <cstdint>
#include <optional>
#include <vector>

namespace talus::analysis {

class Bracket {
 public:
    /// Known to stand at 0 cells; ends at `stop` cells.
    explicit Bracket(std::int64_t stop) : stop_(stop) {}

    void stands(std::int64_t cell) { low_ = cell; }
    /// `out_of_balance` is the plateau of the out-of-balance force: near the critical load it grows in proportion.
    void fails(std::int64_t cell, double out_of_balance);

    /// The assembly came to rest after all at the failing load, with what it has moved: the search goes on upwards from
    /// there, a cell at first, then twice as far each time.
    void reopen();
    /// What failed has been taken out, and the rest stands where the assembly last did: likewise on from there.
    /// \param step  the first one [cells]
    void goOn(std::int64_t step = 1);
    /// The load to probe on the way up: `next`, or nearer after the bracket was opened again. \pre not high()
    std::int64_t up(std::int64_t next);

    std::int64_t low() const { return low_; }
    std::optional<std::int64_t> high() const { return high_; }
    bool closed() const { return high_ && *high_ - low_ <= 1; }
    bool stoodToTheEnd() const { return !high_ && low_ >= stop_; }

    /// The next load to probe: where the out-of-balance forces of the last two failing probes point to, a cell to
    /// either side in turn; the midpoint as long as they do not, or when they have not halved the bracket.
    /// \pre high() and not closed()
    std::int64_t next();

 private:
    std::int64_t midpoint() const { return low_ + (*high_ - low_) / 2; }
    std::optional<double> extrapolated() const;

    struct Failure {
        std::int64_t cell;
        double out_of_balance;
    };
    std::int64_t low_ = 0, stop_ = 0;
    std::int64_t gallop_ = 0;  ///< 0: not reopened
    std::optional<std::int64_t> high_{};
    std::vector<Failure> failures_{};
    std::int64_t width_two_probes_ago_ = 0, width_last_probe_ = 0;
};

}  // namespace talus::analysis
