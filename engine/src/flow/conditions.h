#pragma once
// What holds at the nodes of a network: which boundary each belongs to, and which nodes a head reaches.

#include <vector>

#include "flow/network.h"
#include "talus/flow_data.h"
#include "talus/result.h"

namespace talus::flow {

enum class Condition : std::uint8_t {
    none,    ///< flows balance
    head,    ///< the head is given
    outlet,  ///< no pressure while water flows out, else no flow
    dry,     ///< no head reaches this part of the network
};

struct Conditions {
    std::vector<Condition> of;           ///< each node
    std::vector<std::int32_t> boundary;  ///< of each node, -1: none
    std::vector<double> elevation;       ///< of each node, along -g above the model's origin [m]
    std::vector<double> head;            ///< of nodes with a head [m]
};

/// Where several boundaries take the same node, the first of them counts. Gravity is tilted so [rad].
/// Errors: a boundary without nodes, or wholly above its head; no head at all.
Result<Conditions> conditionsOf(const Network& network, const Flow& flow, const Model& model,
                                const Vec3& origin, double tilt);

}  // namespace talus::flow
