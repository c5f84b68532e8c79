#include "replay/page.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "recording/keep_mechanism.h"
#include "recording/snapshot_view.h"
#include "talus/formats/scenario.h"
#include "talus/motion_roles.h"
#include "talus/searches.h"

namespace talus::tools {

namespace {

constexpr std::size_t kPieceBytes = 12u << 20;  // a multiple of 3: each piece is whole base64 in itself
constexpr std::string_view kPlace = "<!--SNAPSHOT-->";
constexpr std::string_view kMark = "<title>Talus replay</title>";  // every page has it near its start
constexpr std::size_t kMarkWithin = 1000;

/// A temporary file, removed with the object.
class TemporaryFile {
 public:
    TemporaryFile() {
        path_ = (std::filesystem::temp_directory_path() / "talus-replay-XXXXXX").string();
        const int file = mkstemp(path_.data());
        if (file < 0) throw FileRefused(path_, "cannot be written", errno);
        close(file);
    }
    ~TemporaryFile() { unlink(path_.c_str()); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

 private:
    std::string path_;
};

std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileRefused(path, "cannot be read", errno);
    std::stringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

std::vector<std::size_t> chosenFrames(const formats::SnapshotReader& reader, const FrameChoice& choice) {
    std::vector<std::size_t> within, chosen;
    const auto& frames = reader.frames();
    for (std::size_t k = 0; k < frames.size(); ++k)
        if (frames[k].time >= choice.from - 1e-9 && frames[k].time <= choice.to + 1e-9) within.push_back(k);
    for (std::size_t k = 0; k < within.size(); ++k)
        if (k % static_cast<std::size_t>(choice.every) == 0 || k + 1 == within.size())
            chosen.push_back(within[k]);
    return chosen;
}

formats::SnapshotEnd endOf(const formats::SnapshotReader& reader) {
    if (auto end = reader.end()) return *end;
    formats::SnapshotEnd end;
    end.ended = "not known (still running, or killed)";
    return end;
}

void throwIfRefused(const std::vector<Error>& errors) {
    if (!errors.empty()) throw FileRefused(formats::format(errors.front()));
}

/// Bytes of a new file.
std::string written(const std::function<void(formats::SnapshotWriter&)>& frames,
                    const formats::SnapshotEnd& end) {
    const TemporaryFile file;
    auto writer = formats::SnapshotWriter::open(file.path());
    throwIfRefused(writer.errors());
    frames(*writer);
    throwIfRefused(writer->finish(end));
    return contentOf(file.path());
}

std::string repacked(formats::SnapshotReader& reader, const std::string& path, const FrameChoice& choice) {
    const std::vector<std::size_t> frames = chosenFrames(reader, choice);
    if (frames.empty())
        throw BadInput(
            Error{"--from", "there is no frame in this time interval; talus inspect lists the frames", path});
    const auto write = [&](formats::SnapshotWriter& writer) {
        writer.write(reader.header());
        for (const std::size_t k : frames) {
            writer.write(valueOf(reader.frame(k)));
            const auto full = reader.frames()[k].full;
            if (full && choice.contacts) writer.write(valueOf(reader.full(*full)));
        }
    };
    return written(write, endOf(reader));
}

/// Data for the page's script. No text in it can end the element.
std::string jsonElement(const std::string& id, const Json& json) {
    std::string data;
    for (const char c : jsonText(json)) c == '<' ? void(data += "\\u003c") : void(data += c);
    return "<script id=\"" + id + "\" type=\"application/json\">" + data + "</script>\n";
}

/// The page's rule for the motion of a block.
std::string motionRule() {
    const Json rule{{"deflections", MotionRule::kDeflections},
                    {"share", MotionRule::kShare},
                    {"toppling", MotionRule::kToppling},
                    {"pure", MotionRule::kPure},
                    {"deflectionOfSize", MotionRule::kDeflectionOfSize}};
    return jsonElement("motion-rule", rule);
}

/// The page's words for the load of a kept failure, by the names of searches and of limit analyses.
std::string searchWords() {
    Json words = Json::object();
    const auto add = [&](const std::string& name, const VariedQuantity& load) {
        words[name] = {
            {"text", load.text}, {"unit", load.unit}, {"scale", load.scale}, {"decimals", load.decimals + 1}};
    };
    for (const LoadSearch& search : loadSearches()) add(search.name, *search.load);
    for (const VariedQuantity& load : variedQuantities()) add(mechanismSource(load), load);
    return jsonElement("searches", words);
}

void appendBase64(std::string_view bytes, std::string& out) {
    static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const std::size_t left = bytes.size() - k;
        const auto at = [&](std::size_t j) -> unsigned {
            return j < left ? static_cast<unsigned char>(bytes[k + j]) : 0;
        };
        const unsigned group = at(0) << 16 | at(1) << 8 | at(2);
        out += kLetters[group >> 18];
        out += kLetters[group >> 12 & 63];
        out += left > 1 ? kLetters[group >> 6 & 63] : '=';
        out += left > 2 ? kLetters[group & 63] : '=';
    }
}

}  // namespace

std::string snapshotBytes(formats::SnapshotReader& reader, const std::string& path,
                          const FrameChoice& choice) {
    requireFrames(reader, path);
    if (choice.all() && reader.end() && reader.faults().empty()) {
        // The bytes go into the page unchanged, so damage is checked here and not by the page's reader.
        if (const std::vector<std::string> damage = reader.verify(); !damage.empty())
            throw BadInput(Error{"", damage.front() + "; --from and --to leave it out", path});
        return contentOf(path);
    }
    return repacked(reader, path, choice);
}

std::string snapshotBytes(const formats::SnapshotHeader& header, const LightFrame& frame) {
    formats::SnapshotEnd end;
    end.ended = "finished";
    const auto write = [&](formats::SnapshotWriter& writer) {
        writer.write(header);
        writer.write(frame);
    };
    return written(write, end);
}

std::string replayPage(std::string_view snapshot, const Json* map) {
    const std::size_t place = kReplayPage.find(kPlace);
    std::string page(kReplayPage.substr(0, place));
    page.reserve(kReplayPage.size() + snapshot.size() / 3 * 4 + snapshot.size() / kPieceBytes * 100 + 1000);
    page += motionRule() + searchWords();
    if (map != nullptr) page += jsonElement("failure-map", *map);
    for (std::size_t k = 0; k < snapshot.size(); k += kPieceBytes) {
        page += "<script class=\"snapshot\" type=\"text/plain\">";
        appendBase64(snapshot.substr(k, kPieceBytes), page);
        page += "</script>\n";
    }
    page += kReplayPage.substr(place + kPlace.size());
    return page;
}

void writeReplay(const std::string& file, const std::string& page) {
    formats::SnapshotReader reader = openSnapshot(file);
    writeFile(page, replayPage(snapshotBytes(reader, file, FrameChoice{})));
}

void refuseToReplace(const std::string& page, const std::string& snapshot, bool force) {
    std::error_code absent;
    if (std::filesystem::equivalent(page, snapshot, absent))
        throw BadInput(Error{"--output", "is the snapshot file itself; choose another file", page});
    if (force || !std::filesystem::is_regular_file(page, absent)) return;
    std::string start(kMarkWithin, '\0');
    std::ifstream file(page, std::ios::binary);
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    const bool empty = file.gcount() == 0;
    if (!empty && start.find(kMark) == std::string::npos)
        throw BadInput(Error{"--output",
                             "exists and is not a replay page; --force replaces it, or choose another file",
                             page});
}

}  // namespace talus::tools
