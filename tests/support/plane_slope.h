#pragma once
// Plane failure of a slope, as a scenario and by limit equilibrium.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "support/models.h"

namespace talus::test {

inline constexpr double kWater = 1000 * 9.81;  // [N/m^3]

struct PlaneSlope {
    double height = 30, face_deg = 60, plane_deg = 35,
           crack_at = 27.3205;  // [m], from the toe; negative: no crack
    double density = 2650, cohesion = 25e3, friction_deg = 37, k_h = 0;
    double base = -5;   // of the model [m]
    double ground = 0;  ///< in front of the toe [m]
    std::string water{};

    double tan() const { return std::tan(radians(plane_deg)); }
    double crest() const { return height / std::tan(radians(face_deg)); }
    /// Where the plane ends behind the slide.
    double back() const { return crack_at > 0 ? crack_at : height / tan(); }
    double foot() const { return back() * tan(); }  ///< height of that [m]

    std::string scenario() const {
        std::ostringstream text;
        text.precision(12);
        std::ostringstream in_front;
        if (ground > 0) in_front << ", [" << -ground << ", 0]";
        std::ostringstream behind, names;  // what lies on the plane behind the crack stays there
        if (crack_at > 0) {
            names << "names = { behind = [" << crack_at + 0.5 << ", 0.5, " << height - 0.1 << "] }\n";
            behind << ", { name = \"behind\" }";
        }
        const double end = back() + height;
        text << "[material.rock]\ndensity = " << density << "\n"
             << "[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 0.0\n"
             << "[joint.plane]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = "
             << friction_deg << "\ncohesion = " << cohesion << "\nresidual_cohesion = " << cohesion << "\n"
             << "[rock_mass]\nregion = { y = [0, 1], profile = [[" << -ground << ", " << base << "], [" << end
             << ", " << base << "], [" << end << ", " << height << "], [" << crest() << ", " << height
             << "], [0, 0]" << in_front.str() << "] }\n"
             << names.str() << "fixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }" << behind.str()
             << "]\n"
             << "[[single_joint]]\nname = \"plane\"\npoint = [0, 0, 0]\ndip_deg = " << plane_deg
             << "\ndip_direction_deg = 270\n";
        if (crack_at > 0)
            text << "[[single_joint]]\nname = \"crack\"\njoint = \"default\"\npoint = [" << crack_at
                 << ", 0, 0]\ndip_deg = 90\ndip_direction_deg = 270\n";
        if (k_h != 0) text << "[seismic]\nhorizontal = " << k_h << "\n";
        if (!water.empty()) text << "[[water]]\njoint = \"plane\"\n" << water;
        return text.str();
    }

    double weight() const {  ///< of the slide, a slice 1 m thick [N]
        const double below_face = 0.5 * crest() * height + (back() - crest()) * height;
        return density * 9.81 * (below_face - 0.5 * back() * foot());
    }

    /// [C A + (W (cos p - k sin p) - U - V sin p) tan phi] / [W (sin p + k cos p) + V cos p]
    /// \param uplift  on the plane, per metre of height [N/m]
    template <class Pressure>
    double factor(double level, const Pressure& pressure) const {
        const double p = radians(plane_deg), length = foot() / std::sin(p);
        const double depth = std::max(0.0, level - foot());
        const double thrust = crack_at > 0 ? 0.5 * kWater * depth * depth : 0.0;
        double uplift = 0;
        constexpr int kParts = 20000;
        for (int k = 0; k < kParts; ++k)
            uplift += std::max(0.0, pressure(foot() * (k + 0.5) / kParts)) * length / kParts;
        const double c = std::cos(p), s = std::sin(p), w = weight();
        return (cohesion * length +
                (w * (c - k_h * s) - uplift - thrust * s) * std::tan(radians(friction_deg))) /
               (w * (s + k_h * c) + thrust * c);
    }
};

}  // namespace talus::test
