#include "answers/kinematics.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "cli/failures.h"
#include "cli/text.h"
#include "talus/formats/fractures.h"

namespace talus::tools {

namespace {

constexpr const char* kWithoutSet = "without set";

/// The set of a name, made when it is new.
std::size_t setNamed(const std::string& name, std::vector<std::string>& sets) {
    const auto place = static_cast<std::size_t>(std::find(sets.begin(), sets.end(), name) - sets.begin());
    if (place == sets.size()) sets.push_back(name);
    return place;
}

std::vector<Vec3> normalsOf(const std::vector<kinematics::Pole>& poles) {
    std::vector<Vec3> normals;
    normals.reserve(poles.size());
    normals.reserve(poles.size());
    for (const kinematics::Pole& pole : poles) normals.push_back(pole.normal);
    return normals;
}

std::vector<double> weightsOf(const std::vector<kinematics::Pole>& poles) {
    std::vector<double> weights;
    weights.reserve(poles.size());
    weights.reserve(poles.size());
    for (const kinematics::Pole& pole : poles) weights.push_back(pole.weight);
    return weights;
}

/// Scales weights so that they add up to the number of planes.
void normalise(std::vector<kinematics::Pole>& poles) {
    double sum = 0;
    for (const kinematics::Pole& pole : poles) sum += pole.weight;
    for (kinematics::Pole& pole : poles) pole.weight *= static_cast<double>(poles.size()) / sum;
}

std::string weighingOf(const formats::PoleTable& table, const KinematicsQuestion& question) {
    if (question.scanline && (table.has_weight || table.has_spacing || table.has_scanline)) {
        throw BadInput(Error{"--scanline",
                             "found a table that weighs its planes itself, allowed: a table without "
                             "the columns weight, spacing_m and scanline_trend_deg"});
    }
    const bool by_scanline = question.scanline || table.has_scanline;
    if (question.bias_limit && !by_scanline) {
        throw BadInput(Error{"--bias-limit",
                             "found no scanline, allowed: together with --scanline or the columns "
                             "scanline_trend_deg and scanline_plunge_deg"});
    }
    if (by_scanline) return "terzaghi";
    return table.has_weight ? "weight" : table.has_spacing ? "spacing" : "";
}

double weightOf(const formats::MeasuredPole& pole, const std::string& weighing,
                const KinematicsQuestion& question) {
    if (weighing == "weight") return pole.weight;
    if (weighing == "spacing") return 1 / pole.spacing;
    if (weighing.empty()) return 1;
    return kinematics::terzaghiWeight(pole.normal, pole.scanline ? *pole.scanline : *question.scanline,
                                      question.bias_limit.value_or(radians(kBiasLimitDeg)));
}

void refuseTooMany(std::size_t count, const std::string& from) {
    if (count <= kinematics::kMostPoles) return;
    throw BadInput(Error{from, "found " + std::to_string(count) + " planes, allowed: at most " +
                                   std::to_string(kinematics::kMostPoles) +
                                   ", since all pairs of them are tested"});
}

}  // namespace

std::pair<double, double> anglesOf(const std::string& option, const std::string& text, const char* what) {
    const auto slash = text.find('/');
    const auto number = [](std::string_view word) -> std::optional<double> {
        double value = 0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_whole = read.ec == std::errc() && read.ptr == word.data() + word.size();
        return is_whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
    };
    if (slash != std::string::npos) {
        const auto first = number(std::string_view(text).substr(0, slash));
        const auto second = number(std::string_view(text).substr(slash + 1));
        if (first && second) return {*first, *second};
    }
    throw BadInput(Error{option, "found \"" + text + "\", allowed: " + what});
}

Vec3 scanlineOf(double trend, double plunge) {
    if (!(std::abs(plunge) <= 90) || !std::isfinite(trend)) {
        throw BadInput(
            Error{"scanline", "found a plunge of " + text(plunge, 2) + ", allowed: -90 to 90 degrees"});
    }
    const double to = radians(trend), down = radians(plunge);
    return {std::cos(down) * std::sin(to), std::cos(down) * std::cos(to), -std::sin(down)};
}

bool isPoleTable(std::string path) {
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    std::transform(path.begin(), path.end(), path.begin(), small);
    constexpr std::array kEndings{".csv", ".tsv", ".txt", ".dat"};
    return std::any_of(kEndings.begin(), kEndings.end(),
                       [&](const char* ending) { return path.ends_with(ending); });
}

PoleSource polesOf(const formats::PoleTable& table, const KinematicsQuestion& question) {
    PoleSource source;
    source.notation = table.notation;
    source.passed_over = table.passed_over;
    source.weighted_by = weighingOf(table, question);
    refuseTooMany(table.poles.size(), "POLES.csv");
    for (const formats::MeasuredPole& pole : table.poles) {
        const std::string set = !table.has_sets ? "all" : pole.set.empty() ? kWithoutSet : pole.set;
        source.poles.push_back(
            {pole.normal, weightOf(pole, source.weighted_by, question), setNamed(set, source.sets)});
    }
    normalise(source.poles);
    return source;
}

PoleSource polesOf(const formats::Scenario& scenario, const KinematicsQuestion& question) {
    if (question.scanline || question.bias_limit) {
        throw BadInput(Error{
            "--scanline",
            "found a scenario, whose planes were not measured along a scanline, allowed: a table of poles"});
    }
    const auto joints = formats::rockJoints(scenario);
    if (!joints) throw BadInput(joints.errors());
    if (joints->empty()) {
        throw BadInput(Error{
            "SCENARIO", "found no joint set in " + scenario.path +
                            ", allowed: a scenario with [rock_mass] and joints, or a table of poles (.csv)"});
    }
    refuseTooMany(joints->size(), "SCENARIO");
    PoleSource source;
    const Gravity& gravity = scenario.model.gravity;
    source.is_tilted = gravity.tilt != 0 || gravity.direction;
    for (const formats::RockJoint& joint : *joints) {
        source.poles.push_back({kinematics::normalUnderGravity(joint.normal, gravity).normalized(), 1,
                                setNamed(joint.set, source.sets)});
    }
    source.warnings = scenario.warnings;
    return source;
}

KinematicsAnswer answerKinematics(PoleSource source, const KinematicsQuestion& question) {
    const std::vector<Vec3> normals = normalsOf(source.poles);
    if (question.find_sets > 0) {
        const auto found =
            valueOf(kinematics::findSets(normals, question.find_sets, weightsOf(source.poles)));
        source.sets.clear();
        for (std::size_t s = 0; s < question.find_sets; ++s) source.sets.push_back(std::to_string(s + 1));
        for (std::size_t p = 0; p < found.size(); ++p) source.poles[p].set = found[p];
    }
    KinematicsAnswer answer{question, std::move(source), {}, {}, {}};
    const std::vector<kinematics::Pole>& poles = answer.source.poles;
    const std::size_t sets = answer.source.sets.size();
    answer.analysis = valueOf(kinematics::analyse(poles, sets, question.face, question.limits));
    for (std::size_t s = 0; s < sets; ++s) {
        std::vector<kinematics::Pole> own;
        std::copy_if(poles.begin(), poles.end(), std::back_inserter(own),
                     [&](const kinematics::Pole& pole) { return pole.set == s; });
        answer.sets.push_back(kinematics::fisherStatistics(normalsOf(own)));
        if (!answer.source.weighted_by.empty())
            answer.weighted.push_back(kinematics::fisherStatistics(normalsOf(own), weightsOf(own)));
    }
    return answer;
}

}  // namespace talus::tools
