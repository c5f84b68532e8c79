#include "answers/search_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <unordered_map>

#include "cli/text.h"
#include "report/blocks_files.h"
#include "report/numbers.h"
#include "talus/polyhedron.h"

namespace talus::tools {

namespace {

constexpr double kShown =
    0.5;  // of the moving blocks' median size: drawn displacement of the farthest corner
constexpr double kAlike = 1e-6;  // of the model's width: blocks of one slice end there
constexpr View kOblique{235 * kDegree, 25 * kDegree, 0}, kFromTheSide{180 * kDegree, 0, 0};

const BlockLook kStands{"stands", 222, 203, 170}, kFixed{"fixed", 176, 180, 186},
    kOut{"removed before", 240, 228, 66};
/// Apart for the colour-blind, and lighter than the names on them.
const std::array kGroupLooks{BlockLook{"", 240, 120, 50}, BlockLook{"", 86, 170, 222},
                             BlockLook{"", 204, 130, 180}, BlockLook{"", 60, 180, 140},
                             BlockLook{"", 200, 160, 60}};

/// The blocks that fail together, and at which load.
struct Group {
    std::string words;
    const std::vector<std::string>& blocks;
};

class SearchPicture {
 public:
    SearchPicture(const LoadSearch& search, const SearchResult& result, const formats::Scenario& scenario)
        : search_(search), result_(result), scenario_(scenario), moved_(scenario.model) {
        for (std::size_t b = 0; b < moved_.blocks.size(); ++b) numbers_.emplace(moved_.blocks[b].name, b);
    }

    std::string svg() {
        moveBlocks();
        View view = isSection() ? kFromTheSide : kOblique;
        view.tilt = tilt();
        const Painting painting = this->painting();
        return blocksSvg(moved_, view, painting.heading, painting);
    }

 private:
    std::string loadOf(double load) const { return loadFigure(search_, load, search_.load->decimals); }

    /// The load at which it fails, or up to which it is stable.
    double tilt() const {
        if (search_.load->varied != Varied::tilt) return scenario_.model.gravity.tilt;
        if (result_.status == SearchStatus::found) return result_.answer;
        return std::isfinite(result_.low) ? result_.low : result_.high;
    }

    bool isSection() const {
        if (scenario_.model.stack) return true;  // its slices are alike
        double low = kInfinity, high = -kInfinity;
        for (const Block& block : scenario_.model.blocks)
            if (block.motion == Motion::free)
                for (const Vec3& v : block.shape.vertices)
                    low = std::min(low, v.y()), high = std::max(high, v.y());
        const double least = kAlike * (high - low);
        return std::all_of(scenario_.model.blocks.begin(), scenario_.model.blocks.end(),
                           [&](const Block& block) {
                               const auto& corners = block.shape.vertices;
                               return block.motion != Motion::free ||
                                      std::all_of(corners.begin(), corners.end(), [&](const Vec3& v) {
                                          return v.y() < low + least || v.y() > high - least;
                                      });
                           });
    }

    std::string heading() const {
        const std::string name = std::filesystem::path(scenario_.path).filename().string() + ": ";
        const std::string unit = *search_.load->unit == '\0' ? "" : std::string(" ") + search_.load->unit;
        switch (result_.status) {
            case SearchStatus::found:
                return name + search_.answer + " " + loadOf(result_.answer) + unit + ", " +
                       talus::toString(result_.mode);
            case SearchStatus::unstable_at_start:
                return name + "unstable at the start of the search, " + loadOf(result_.high) + unit;
            case SearchStatus::stable_to_stop:
                return name + "stable up to the largest load tried, " + loadOf(result_.low) + unit;
            case SearchStatus::interrupted:
            case SearchStatus::undecided:
                break;
        }
        return name + search_.answer + " undecided";
    }

    std::vector<Group> groups() const {
        std::vector<Group> groups;
        for (const BlockGroup& group : result_.groups)
            groups.push_back(
                {(groups.empty() ? "fails at " : "then at ") + loadOf(group.factor), group.blocks});
        if (groups.empty() && !result_.moving_blocks.empty())
            groups.push_back({"fails", result_.moving_blocks});
        return groups;
    }

    Painting painting() const {
        Painting painting{{kStands, kFixed, kOut}, {}, heading(), remark()};
        for (const Block& block : moved_.blocks)
            painting.look_of_block.push_back(block.motion == Motion::free ? 0 : 1);
        const auto paint = [&](const std::vector<std::string>& names, std::size_t look) {
            for (const std::string& name : names)
                if (const auto b = numbers_.find(name); b != numbers_.end())
                    painting.look_of_block[b->second] = look;
        };
        paint(leftOut(result_), 2);
        for (const Group& group : groups()) {
            BlockLook look = kGroupLooks[(painting.looks.size() - 3) % kGroupLooks.size()];
            look.words = group.words;
            painting.looks.push_back(std::move(look));
            paint(group.blocks, painting.looks.size() - 1);
        }
        return painting;
    }

    std::string remark() const {
        if (enlarged_ == 0) return "";
        char text[64];
        const double unit = std::pow(10.0, std::floor(std::log10(enlarged_)) - 1);  // two digits
        std::snprintf(text, sizeof text, "displacements enlarged %g times",
                      unit * std::round(enlarged_ / unit));
        return text;
    }

    // --- motion
    // ------------------------------------------------------------------------------------------------------

    /// The motion of the failing blocks.
    std::vector<std::pair<std::size_t, const BlockMotion*>> motions() const {
        std::vector<std::pair<std::size_t, const BlockMotion*>> list;
        for (const BlockMotion& motion : result_.motions)
            if (const auto b = numbers_.find(motion.block); motion.moving && b != numbers_.end())
                list.emplace_back(b->second, &motion);
        return list;
    }

    void moveBlocks() {
        const auto moving = motions();
        double farthest = 0;
        std::vector<double> sizes;
        for (const auto& [b, motion] : moving) {
            const Polyhedron& shape = moved_.blocks[b].shape;
            const Vec3 centre = massProperties(shape).centroid;
            sizes.push_back(smallestExtent(shape));
            for (const Vec3& v : shape.vertices)
                farthest = std::max(farthest, (motion->translation + motion->turn.cross(v - centre)).norm());
        }
        if (!(farthest > 0)) return;
        const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
        std::nth_element(sizes.begin(), middle, sizes.end());
        enlarged_ = kShown * *middle / farthest;
        for (const auto& [b, motion] : moving) move(moved_.blocks[b].shape, *motion);
    }

    void move(Polyhedron& shape, const BlockMotion& motion) const {
        const Vec3 centre = massProperties(shape).centroid;
        const double angle = enlarged_ * motion.turn.norm();
        const Mat3 turn = angle > 0
                              ? Mat3(Eigen::AngleAxisd(angle, motion.turn.normalized()).toRotationMatrix())
                              : Mat3(Mat3::Identity());
        for (Vec3& v : shape.vertices) v = centre + enlarged_ * motion.translation + turn * (v - centre);
    }

    const LoadSearch& search_;
    const SearchResult& result_;
    const formats::Scenario& scenario_;
    Model moved_;
    std::unordered_map<std::string, std::size_t> numbers_{};  ///< of the blocks, by name
    double enlarged_ = 0;  ///< drawn motion over that of the search; 0: nothing moves
};

}  // namespace

std::string searchPicture(const LoadSearch& search, const SearchResult& result,
                          const formats::Scenario& scenario) {
    return SearchPicture(search, result, scenario).svg();
}

}  // namespace talus::tools
