#include "scenario/interface.h"

#include <algorithm>
#include <map>
#include <set>

namespace talus::formats::scenario {

namespace {

using BlockPair = std::pair<std::int32_t, std::int32_t>;

BlockPair blocksOf(const PairJoint& pair) { return std::minmax(pair.block_a, pair.block_b); }

}  // namespace

std::optional<BlockPair> readBetween(Report& report, TableReader& table, const BlockDirectory& blocks) {
    const auto names = table.texts("between", 2);
    if (!names) return std::nullopt;
    const Node list = *table.find("between");
    const std::string field = table.fieldOf("between");
    const auto a = blocks.resolve(report, list.at(0).place(), elementField(field, 0), (*names)[0]);
    const auto b = blocks.resolve(report, list.at(1).place(), elementField(field, 1), (*names)[1]);
    if (!a || !b) return std::nullopt;
    if (*a != *b) return BlockPair(*a, *b);
    table.error("between", "found " + quoted((*names)[0]) + " twice, allowed: two different blocks");
    return std::nullopt;
}

std::vector<PairJoint> readInterfaces(Report& report, TableReader& root, const BlockDirectory& blocks,
                                      Joints& joints) {
    std::vector<std::string> keys = jointKeys();
    keys.insert(keys.begin(), {"between", "joint"});
    std::vector<PairJoint> interfaces;
    std::map<BlockPair, std::string> first;
    for (const FieldNode& entry : root.tables("interface")) {
        TableReader table(report, entry.node, entry.field, keys);
        table.require({"between", "joint"});
        const auto between = readBetween(report, table, blocks);
        const auto joint = table.has("joint") ? readJoint(report, table, "joint", joints) : std::nullopt;
        const auto own = joint ? joints.withOverrides(*joint, table, entry.field) : 0;
        if (!between) continue;
        const PairJoint pair{between->first, between->second, own, true, entry.field};
        const auto [earlier, is_new] = first.emplace(blocksOf(pair), entry.field);
        if (is_new)
            interfaces.push_back(pair);
        else
            table.error("between",
                        "found the blocks of " + earlier->second + " again, allowed: each pair once");
    }
    return interfaces;
}

void addInterfaces(const std::vector<PairJoint>& interfaces, Model& model) {
    std::set<BlockPair> by_hand;
    for (const PairJoint& pair : interfaces) by_hand.insert(blocksOf(pair));
    auto& pairs = model.pair_joints;
    if (!by_hand.empty())
        pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                                   [&](const PairJoint& pair) { return by_hand.count(blocksOf(pair)) > 0; }),
                    pairs.end());
    pairs.insert(pairs.end(), interfaces.begin(), interfaces.end());
}

}  // namespace talus::formats::scenario
