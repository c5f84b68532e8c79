// The stereonet of a kinematic analysis: poles or lines over their zones, and the legend.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "answers/kinematics_net.h"
#include "cli/failures.h"
#include "cli/text.h"
#include "talus/fractures.h"
#include "talus/rock_mass.h"

namespace talus::tools {

namespace {

using kinematics::Face;
using kinematics::Limits;

constexpr double kNetRadius = 270, kWidth = 640, kTop = 64;  // [px]
constexpr double kLine = 22, kLeft = 24, kSymbol = 36;       // of the legend [px]
constexpr std::size_t kMostDrawn = 5000;       ///< lines of intersection: more are one grey area
constexpr std::size_t kMostContoured = 20000;  ///< lines that contours are made of, a sample beyond
constexpr std::size_t kMostPaired = 2000;  ///< poles whose lines are looked for: two million pairs, a second

const char* symbolOf(std::size_t set) {
    constexpr std::array kSymbols{"circle", "triangle", "square"};
    return kSymbols[set % kSymbols.size()];
}

class Picture {
 public:
    Picture(const KinematicsAnswer& answer, const NetPicture& wanted)
        : answer_(answer),
          wanted_(wanted),
          face_(answer.question.face),
          limits_(answer.question.limits),
          net_({kWidth / 2, kTop + kNetRadius}, kNetRadius, wanted.projection) {
        if (wanted_.intersections) findLines();
    }

    std::string file(const std::string& title) {
        svg_.label({kLeft, 26}, title, "start", "caption");
        svg_.beginClip(net_.middle(), kNetRadius);
        if (wanted_.contours) contour();
        drawZones(svg_, net_, answer_.question, wanted_.intersections);
        svg_.endClip();
        net_.draw(svg_, std::string(nameOf(wanted_.projection)) +
                            ", lower hemisphere; rings 30 and 60 from the middle");
        drawLimits(svg_, net_, answer_.question, wanted_.intersections);
        for (std::size_t s = 0; s < answer_.sets.size(); ++s)
            svg_.shape(net_.greatCircle(answer_.sets[s].mean), true, "mean " + numbered("mean", s));
        if (wanted_.intersections) {
            drawLines();
        } else {
            drawPoles();
        }
        svg_.label(net_.onPage(*kinematics::dipVector(upwardNormal(face_.dip, face_.dip_direction))), "face",
                   "middle", "name");
        drawLegend();
        return svg_.file(
            kWidth, at_ + 6, title,
            wanted_.intersections
                ? "Lines of intersection on the lower hemisphere, wedge sliding and direct toppling"
                : "Poles on the lower hemisphere, planar sliding and flexural toppling",
            kNetStyle);
    }

 private:
    struct Crossing {
        Vec3 line;
        double weight;
        bool is_critical;
    };

    void findLines() {
        const auto& poles = answer_.source.poles;
        stride_ = 1 + (poles.size() - 1) / kMostPaired;
        for (std::size_t i = 0; i < poles.size(); i += stride_) {
            for (std::size_t j = i + stride_; j < poles.size(); j += stride_) {
                const auto line = kinematics::intersection(poles[i].normal, poles[j].normal);
                if (!line) continue;
                const bool is_critical =
                    wedgeZone(*line, face_, limits_.friction) != kinematics::WedgeZone::none ||
                    topplingZone(*line, face_, limits_) != kinematics::TopplingZone::none;
                lines_.push_back({*line, poles[i].weight * poles[j].weight, is_critical});
            }
        }
    }

    void contour() {
        std::vector<Vec3> axes;
        std::vector<double> weights;
        const auto add = [&](const Vec3& axis, double weight) {
            axes.push_back(axis);
            weights.push_back(weight);
        };
        if (wanted_.intersections) {
            for (std::size_t k = 0; k < lines_.size(); k += 1 + lines_.size() / kMostContoured)
                add(lines_[k].line, lines_[k].weight);
        } else {
            for (const kinematics::Pole& pole : answer_.source.poles) add(pole.normal, pole.weight);
        }
        if (!axes.empty()) levels_ = drawContours(svg_, net_, axes, weights, wanted_.counting);
    }

    void drawPoles() {
        std::set<std::tuple<std::size_t, long, long>> drawn;  // many of one set at one place are one
        for (const bool critical : {false, true}) {
            for (const kinematics::Pole& pole : answer_.source.poles) {
                const bool is_critical = planarSliding(pole.normal, face_, limits_) ||
                                         flexuralToppling(pole.normal, face_, limits_);
                const Spot at = net_.onPage(Vec3(-pole.normal));
                if (is_critical != critical ||
                    !drawn.emplace(pole.set, std::lround(10 * at.x), std::lround(10 * at.y)).second)
                    continue;
                svg_.symbol(symbolOf(pole.set), at, 4.2,
                            std::string(critical ? "critical " : "pole ") + numbered("set", pole.set),
                            answer_.source.sets[pole.set] + " " + planeText(pole.normal));
            }
        }
        for (std::size_t s = 0; s < answer_.sets.size(); ++s) {
            const Spot at = net_.onPage(Vec3(-answer_.sets[s].mean));
            svg_.symbol(symbolOf(s), at, 9, "mean " + numbered("mean", s),
                        "mean of " + answer_.source.sets[s]);
            svg_.label({at.x + 13, at.y + 5}, answer_.source.sets[s], at.x > kWidth - 90 ? "end" : "start",
                       "name");
        }
    }

    /// A sample of them where there are many, each place once.
    void drawLines() {
        const std::size_t every = 1 + lines_.size() / kMostDrawn;
        const double r = lines_.size() > 1000 ? 1.2 : 2.2;
        std::set<std::tuple<bool, long, long>> drawn;
        for (const bool critical : {false, true}) {
            for (std::size_t k = 0; k < lines_.size(); k += every) {
                const Spot at = net_.onPage(lines_[k].line);
                if (lines_[k].is_critical == critical &&
                    drawn.emplace(critical, std::lround(at.x), std::lround(at.y)).second)
                    svg_.symbol("circle", at, r, critical ? "linecritical" : "line");
            }
        }
        if (every > 1 || stride_ > 1) note_ = "drawn: a sample of the lines, critical ones red";
    }

    // --- legend
    // -------------------------------------------------------------------------------------------------

    template <class Draw>
    void entry(const std::string& words, const Draw& draw) {
        draw(Spot{kLeft, at_ - 5});
        svg_.label({kLeft + kSymbol, at_}, words);
        at_ += kLine;
    }

    void patch(const char* role, const std::string& words) {
        entry(words, [&](Spot at) { svg_.box({at.x, at.y - 7}, {at.x + 26, at.y + 7}, role); });
    }

    void stroke(const std::string& role, const std::string& words) {
        entry(words, [&](Spot at) { svg_.line(at, {at.x + 26, at.y}, role); });
    }

    static std::string planeText(const Vec3& normal) {
        const auto [dip, direction] = dipOf(normal);
        return angleText(dip) + "/" + angleText(direction);
    }

    static std::string shareText(const char* name, const kinematics::Share& share, const char* of) {
        return std::string(name) + ": " + std::to_string(share.critical) + " of " +
               std::to_string(share.total) + " " + of + " (" + text(share.percent(), 1) + " %)";
    }

    void drawLegend() {
        at_ = kTop + 2 * kNetRadius + 52;
        const kinematics::PlaneShares& planes = answer_.analysis.planes;
        const kinematics::LineShares& lines = answer_.analysis.lines;
        if (wanted_.intersections) {
            patch("slides", shareText("wedge sliding", lines.wedge, "lines") + ", " +
                                std::to_string(lines.primary) + " in the primary zone");
            patch("second", std::to_string(lines.secondary) +
                                " in the secondary zone, of which friction holds " +
                                std::to_string(lines.held_by_friction));
            patch("topples", shareText("direct toppling", lines.direct, "lines"));
            patch("oblique", shareText("oblique toppling", lines.oblique, "lines"));
        } else {
            patch("slides", shareText("planar sliding", planes.planar, "poles"));
            patch("topples", shareText("flexural toppling", planes.flexural, "poles"));
        }
        drawLimitEntries();
        for (std::size_t s = 0; s < answer_.sets.size(); ++s) drawSetEntry(s);
        if (levels_.count > 0) drawLevels();
        svg_.label({kLeft, at_}, "angles in degrees, planes as dip/dip direction", "start", "small");
        at_ += kLine;
        if (note_.empty()) return;
        svg_.label({kLeft, at_}, note_, "start", "small");
        at_ += kLine;
    }

    void drawLimitEntries() {
        stroke("face", "face " + angleText(face_.dip) + "/" + angleText(face_.dip_direction));
        stroke("friction", (wanted_.intersections ? "friction cone and plane " : "friction cone ") +
                               angleText(limits_.friction));
        stroke("lateral", "lateral limits " + angleText(limits_.lateral) + " to each side");
        if (wanted_.intersections) return stroke("slip", "lines that plunge at 90 minus the dip of the face");
        stroke("daylight", "daylight envelope");
        if (face_.dip > limits_.friction)
            stroke("slip", "slip limit " + angleText(face_.dip - limits_.friction));
    }

    void drawSetEntry(std::size_t s) {
        const kinematics::FisherStatistics& set = answer_.sets[s];
        std::string words = answer_.source.sets[s] + ": " + std::to_string(set.count) +
                            (set.count == 1 ? " pole, " : " poles, mean ") + planeText(set.mean);
        if (set.k) words += ", K " + text(*set.k, 1);
        if (set.cone_95) words += ", mean within " + text(degrees(*set.cone_95), 1);
        entry(words, [&](Spot at) {
            svg_.line(at, {at.x + 26, at.y}, "mean " + numbered("mean", s));
            svg_.symbol(symbolOf(s), {at.x + 13, at.y}, 6, "critical " + numbered("set", s));
        });
    }

    void drawLevels() {
        for (std::size_t k = 0; k < levels_.count; ++k) {
            const double left = kLeft + 62 * static_cast<double>(k);
            svg_.box({left, at_ - 14}, {left + 24, at_}, numbered("level", k));
            svg_.label({left + 28, at_ - 1},
                       text(levels_.step * static_cast<double>(k + 1), levels_.step < 1 ? 1 : 0), "start",
                       "small");
        }
        at_ += kLine - 2;
        const std::string area = shownAngle(100 * wanted_.counting.area) + " % of the area";
        svg_.label({kLeft, at_},
                   (wanted_.intersections ? "% of the lines" : "% of the poles") +
                       std::string(answer_.weighted.empty() ? "" : ", by weight,") + " per " + area +
                       (wanted_.counting.fisher ? ", each spread by Fisher's distribution"
                                                : ", counted in a circle"),
                   "start", "small");
        at_ += kLine;
    }

    static std::string shownAngle(double value) {
        std::string words = text(value, 2);
        while (words.ends_with('0')) words.pop_back();
        if (words.ends_with('.')) words.pop_back();
        return words;
    }
    static std::string angleText(double angle) {
        std::string words = text(degrees(angle), 1);
        return words.ends_with(".0") ? words.substr(0, words.size() - 2) : words;
    }

    const KinematicsAnswer& answer_;
    const NetPicture& wanted_;
    const Face& face_;
    const Limits& limits_;
    Net net_;
    SvgWriter svg_;
    std::vector<Crossing> lines_;
    NetLevels levels_;
    std::string note_;
    std::size_t stride_ = 1;  ///< the lines of every n-th pole are drawn
    double at_ = 0;           ///< where the legend goes on [px]
};

}  // namespace

NetPicture netPicture(const std::string& view, const std::string& projection, const std::string& contours,
                      double counting_area) {
    const auto checked = [](const char* field, const std::string& word, const auto& allowed) {
        std::string list;
        for (const char* each : allowed) {
            if (word == each) return;
            list += (list.empty() ? "" : ", ") + std::string(each);
        }
        throw BadInput(Error{field, "found \"" + word + "\", allowed: " + list});
    };
    checked("view", view, kNetViews);
    checked("net", projection, kNetProjections);
    checked("contours", contours, kNetContours);
    if (!(counting_area >= 0.1 && counting_area <= 20)) {
        throw BadInput(Error{"counting_area",
                             "found " + text(counting_area, 3) + ", allowed: 0.1 to 20 % of the hemisphere"});
    }
    return {projection == kNetProjections[0] ? Projection::equal_area : Projection::equal_angle,
            view != kNetViews[0],
            {contours == kNetContours[0], counting_area / 100},
            contours != kNetContours[2]};
}

std::string kinematicsSvg(const KinematicsAnswer& answer, const NetPicture& picture,
                          const std::string& title) {
    return Picture(answer, picture).file(title);
}

}  // namespace talus::tools
