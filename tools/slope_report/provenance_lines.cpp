#include "slope_report/provenance_lines.h"

#include <filesystem>

#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/text.h"
#include "report/page.h"

namespace talus::tools {

std::string fileName(const SlopeReport& report) {
    return std::filesystem::path(report.search.scenario.path).filename().string();
}

std::vector<std::pair<std::string, std::string>> provenanceItems(const SlopeReport& report) {
    const formats::Scenario& scenario = report.search.scenario;
    Json facts = provenance(report.search.common, scenario.path);
    facts.erase("threads");
    auto items = provenanceFacts(facts);
    for (const auto& [name, digest] : inputDigests(scenario)) items.emplace_back("xxh128 of " + name, digest);
    items.emplace_back("state hash", hashText(report.search.result.state_hash));
    return items;
}

std::string provenanceLines(const SlopeReport& report) {
    std::string lines;
    for (auto [term, value] : provenanceItems(report)) {
        for (char& c : value)
            if (c == '\n' || c == '\r') c = ' ';  // a line break in an argument must not end the comment
        lines += "# " + term + ": " + value + "\n";
    }
    return lines;
}

}  // namespace talus::tools
