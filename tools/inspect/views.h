#pragma once
// The views of `talus inspect`: each is a few facts and a table.

#include "cli/json.h"
#include "recording/snapshot_view.h"
#include "report/table.h"

namespace talus::tools {

struct View {
    Json facts = Json::object();
    std::string title;  ///< of the facts, in text
    std::string table_name;
    Table table;
};

View viewSummary(formats::SnapshotReader& reader, const std::string& path);
View viewFrame(formats::SnapshotReader& reader, std::size_t frame);

/// The blocks that have moved most (`by` displacement, rotation) or are fastest (velocity).
View viewTop(formats::SnapshotReader& reader, std::size_t frame, std::size_t count, const std::string& by);

/// Pose and velocity of a block, and the forces of its neighbours on it.
View viewBlock(formats::SnapshotReader& reader, std::size_t frame, const std::string& name,
               const std::string& path);

/// Every Lp between two blocks.
View viewInterface(formats::SnapshotReader& reader, std::size_t frame, const std::string& a,
                   const std::string& b, const std::string& path);

/// Verifies all checksums and hashes; `sound` in the facts.
View viewVerify(formats::SnapshotReader& reader);

/// First differing frame and field of two files; `equal` in the facts.
View viewDifference(formats::SnapshotReader& reader, formats::SnapshotReader& other,
                    const std::string& other_path);

}  // namespace talus::tools
