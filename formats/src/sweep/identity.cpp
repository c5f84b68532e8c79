// What a sweep is, as one hash: two batches with the same identity compute the same runs.

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <charconv>
#include <cstdio>

#include "talus/formats/sweep.h"
#include "toml/document.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace {

/// Every bit of a number counts.
std::string exact(double value) {
    std::array<char, 40> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string exact(const SweepValue& value) {
    const auto* real = std::get_if<double>(&value);
    return std::to_string(value.index()) + ":" + (real ? exact(*real) : toString(value));
}

std::string describe(const SweepColumn& column) {
    const Distribution& d = column.distribution;
    std::string text = "\n" + column.name + "\n" + std::to_string(static_cast<int>(column.source)) + " " +
                       std::to_string(static_cast<int>(column.per));
    for (const std::string& target : column.targets) text += "\n>" + target;
    for (const SweepValue& value : column.values) text += "\n=" + exact(value);
    if (column.source != SweepSource::random) return text;
    text += std::string("\n") + toString(d.kind);
    for (const double value : {d.min, d.max, d.mean, d.sd, d.mode, d.alpha, d.beta})
        text += " " + exact(value);
    for (const ScoreShare& part : column.scores)
        text += "\n~" + std::to_string(part.column) + " " + exact(part.weight);
    return text;
}

}  // namespace

std::string identityOf(const Sweep& sweep) {
    std::string text = std::string(sweep.analysis()) + "\n" + std::to_string(sweep.seed) + "\n" +
                       (sweep.latin_hypercube ? "lhs " + std::to_string(sweep.samples) : "random");
    if (sweep.tries_histories) text += "\nrange";
    if (sweep.groups > 1) text += "\ngroups " + std::to_string(sweep.groups);
    for (const SweepColumn& column : sweep.columns) text += describe(column);
    const auto document = toml::Document::parse(sweep.scenario_text, sweep.scenario_path);
    text += "\n\n" + (document ? toml::writeDocument(*document) : sweep.scenario_text);
    std::array<char, 17> hash{};
    std::snprintf(hash.data(), hash.size(), "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(text.data(), text.size())));
    return hash.data();
}

}  // namespace talus::formats
