#include "answers/search_files.h"

#include <CLI/CLI.hpp>
#include <functional>

#include "answers/search_picture.h"
#include "answers/search_plot.h"
#include "cli/files.h"
#include "cli/json.h"
#include "report/svg.h"

namespace talus::tools {

namespace {

constexpr const char *kPlot = "plot", *kPicture = "picture";

std::string optionOf(const char* key) { return std::string("--") + key; }

DrawnFile draw(const char* key, const std::string& path, const std::function<std::string()>& content) {
    DrawnFile drawn{key, path, ""};
    try {
        writeFile(path, content());
    } catch (const FileRefused& refused) {
        drawn = {key, "", refused.what(), kFileRefused};
    }
    return drawn;
}

std::string whyNoPath(const SearchResult& result) {
    if (result.status == SearchStatus::unstable_at_start)
        return "it fails before the search begins, so there is no curve";
    return result.status == SearchStatus::interrupted ? "the search was interrupted"
                                                      : "the search is undecided";
}

}  // namespace

void addSearchFiles(CLI::App& app, SearchFiles& files) {
    app.add_option("--plot", files.plot,
                   "FILE.svg: the curve of load against displacement with the answer and its bracket");
    app.add_option("--picture", files.picture,
                   "FILE.svg: the blocks; those that fail are coloured by group and drawn displaced");
}

void refuseSearchFiles(const SearchFiles& files) {
    if (!files.plot.empty() && files.plot == files.picture) {
        throw BadInput(Error{optionOf(kPicture), "found \"" + files.picture +
                                                     "\", which is the file of --plot; choose another name"});
    }
    refuseOutput(optionOf(kPlot), files.plot, ".svg");
    refuseOutput(optionOf(kPicture), files.picture, ".svg");
}

std::vector<DrawnFile> drawSearchFiles(const SearchFiles& files, const LoadSearch& search,
                                       const SearchResult& result, const formats::Scenario& scenario) {
    std::vector<DrawnFile> drawn;
    if (!files.plot.empty()) {
        const double failure = failureDisplacement(result, scenario.model);
        drawn.push_back(
            result.path.empty() ? DrawnFile{kPlot, "", whyNoPath(result)} : draw(kPlot, files.plot, [&] {
                return svgFile(searchPlot(search, result, scenario.path, failure), true);
            }));
    }
    if (!files.picture.empty())
        drawn.push_back(
            draw(kPicture, files.picture, [&] { return searchPicture(search, result, scenario); }));
    return drawn;
}

Json drawnFileJson(const DrawnFile& drawn) {
    return {{"file", drawn.file.empty() ? Json(nullptr) : Json(drawn.file)},
            {"reason", drawn.reason.empty() ? Json(nullptr) : Json(drawn.reason)}};
}

}  // namespace talus::tools
