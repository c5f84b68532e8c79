// talus inspect: a block and its neighbours, an interface and its contact points.

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/text.h"
#include "inspect/views.h"

namespace talus::tools {

namespace {

/// Sums over the Lps of one interface.
struct Sums {
    double normal = 0, shear_1 = 0, shear_2 = 0, water = 0, area = 0, open_area = 0, strength = 0, shear = 0;
};

Sums sumsOf(const FullFrame& full, std::size_t i) {
    Sums sums;
    const FramePoints& p = full.points;
    for (auto k = static_cast<std::size_t>(full.interfaces.point_begin[i]);
         k < static_cast<std::size_t>(full.interfaces.point_begin[i + 1]); ++k) {
        sums.normal += p.normal[k];
        sums.shear_1 += p.shear_1[k];
        sums.shear_2 += p.shear_2[k];
        sums.water += static_cast<double>(p.water[k]);
        sums.area += p.area[k];
        if (p.state[k] == PointState::open) sums.open_area += p.area[k];
        // |S| over strength is what is stored; the strength follows where an Lp carries shear.
        const double shear = std::hypot(p.shear_1[k], p.shear_2[k]);
        if (p.mobilised[k] <= 0) continue;
        sums.shear += shear;
        sums.strength += shear / static_cast<double>(p.mobilised[k]);
    }
    return sums;
}

Json share(double part, double whole) { return whole > 0 ? number(part / whole) : Json(nullptr); }

std::string jointName(const formats::SnapshotHeader& header, std::int32_t joint) {
    return header.joints[static_cast<std::size_t>(joint)].name;
}

}  // namespace

View viewBlock(formats::SnapshotReader& reader, std::size_t frame, const std::string& name,
               const std::string& path) {
    const formats::SnapshotHeader& header = reader.header();
    const std::size_t b = blockIndex(header, name, path);
    const LightFrame light = valueOf(reader.frame(frame));
    View view;
    view.title = "block " + name;
    view.facts = {{"block", name},
                  {"frame", frame},
                  {"time_s", number(light.time)},
                  {"mass_kg", number(header.geometry.mass[b])},
                  {"position_m", vector(get(header.geometry.centroid, b) + get(light.displacement, b))},
                  {"displacement_m", vector(get(light.displacement, b))},
                  {"velocity_m_s", vector(get(light.velocity, b))},
                  {"rotation_deg", vector(get(light.rotation, b) / kDegree)}};
    const FullFrame full = fullAt(reader, frame, path);
    view.facts["contacts_at_s"] = number(full.time);
    view.facts["out_of_balance_force_n"] = vector(get(full.blocks.force, b));
    view.table_name = "neighbours";
    view.table.columns = {"neighbour", "joint",   "area_m2", "force_x_n",  "force_y_n",         "force_z_n",
                          "normal_n",  "shear_n", "water_n", "open_share", "mobilised_friction"};
    const FrameInterfaces& f = full.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const bool is_a = f.block_a[i] == static_cast<std::int32_t>(b),
                   is_b = f.block_b[i] == static_cast<std::int32_t>(b);
        if ((!is_a && !is_b) || f.isIdle(i)) continue;
        const Sums sums = sumsOf(full, i);
        const Vec3 force = (is_b ? 1.0 : -1.0) * get(f.force, i);
        const auto other = static_cast<std::size_t>(is_a ? f.block_b[i] : f.block_a[i]);
        view.table.rows.push_back({header.names[other], jointName(header, f.joint[i]), number(f.area[i]),
                                   number(force.x()), number(force.y()), number(force.z()),
                                   number(sums.normal), number(std::hypot(sums.shear_1, sums.shear_2)),
                                   number(sums.water), share(sums.open_area, sums.area),
                                   share(sums.shear, sums.strength)});
    }
    return view;
}

View viewInterface(formats::SnapshotReader& reader, std::size_t frame, const std::string& first,
                   const std::string& second, const std::string& path) {
    const formats::SnapshotHeader& header = reader.header();
    const auto a = static_cast<std::int32_t>(blockIndex(header, first, path));
    const auto b = static_cast<std::int32_t>(blockIndex(header, second, path));
    const FullFrame full = fullAt(reader, frame, path);
    const FrameInterfaces& f = full.interfaces;
    const FramePoints& p = full.points;
    View view;
    view.title = "between " + first + " and " + second;
    view.table_name = "points";
    view.table.columns = {"interface", "point",   "x_m",     "y_m",   "z_m",  "area_m2",
                          "normal_n",  "shear_n", "water_n", "state", "bond", "mobilised_friction"};
    Json interfaces = Json::array();
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (std::minmax(f.block_a[i], f.block_b[i]) != std::minmax(a, b) || f.isIdle(i)) continue;
        const PlacedInterface at = placed(full, i);
        const Sums sums = sumsOf(full, i);
        interfaces.push_back({{"reference_block", header.names[static_cast<std::size_t>(f.block_a[i])]},
                              {"joint", jointName(header, f.joint[i])},
                              {"area_m2", number(f.area[i])},
                              {"normal", vector(at.e3)},
                              {"normal_n", number(sums.normal)},
                              {"shear_n", number(std::hypot(sums.shear_1, sums.shear_2))},
                              {"water_n", number(sums.water)},
                              {"open_share", share(sums.open_area, sums.area)},
                              {"mobilised_friction", share(sums.shear, sums.strength)}});
        const auto begin = static_cast<std::size_t>(f.point_begin[i]);
        for (auto k = begin; k < static_cast<std::size_t>(f.point_begin[i + 1]); ++k) {
            const Vec3 x = at.at(p.xi[k], p.eta[k]);
            view.table.rows.push_back({interfaces.size() - 1, k - begin, number(x.x()), number(x.y()),
                                       number(x.z()), number(p.area[k]), number(p.normal[k]),
                                       number(std::hypot(p.shear_1[k], p.shear_2[k])),
                                       number(static_cast<double>(p.water[k])), toString(p.state[k]),
                                       number(p.bond[k]), number(static_cast<double>(p.mobilised[k]))});
        }
    }
    if (interfaces.empty())
        throw BadInput(Error{"--interface",
                             "\"" + first + "\" and \"" + second + "\" do not touch at t = " +
                                 text(full.time, 6) + " s; --block " + first + " lists its neighbours",
                             path});
    view.facts = {{"frame", frame}, {"contacts_at_s", number(full.time)}, {"interfaces", interfaces}};
    return view;
}

}  // namespace talus::tools
