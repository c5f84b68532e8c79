#include "support/drawn_models.h"

#include <cmath>
#include <sstream>
#include <vector>

#include "support/draw.h"

namespace talus::test {
namespace {

constexpr double kDegree = M_PI / 180;

struct Text {
    std::ostringstream out{};
    int blocks = 0;

    Text() { out.precision(6); }

    void strength(Draw& draw, double least_friction, double most_friction, double softest = 1e9) {
        const double stiffness = draw.magnitude(softest, 1e12);
        out << "[material.rock]\ndensity = " << std::round(draw.between(2000, 3000))
            << "\n[joint.default]\nnormal_stiffness = " << stiffness
            << "\nshear_stiffness = " << stiffness * draw.between(0.1, 1)
            << "\nfriction_deg = " << draw.between(least_friction, most_friction) << "\n";
    }
    void box(double x, double z, double width, double height, double depth, bool fixed = false) {
        out << "[[block]]\nname = \"" << (fixed ? "fixed" : "b") << ++blocks << "\"\nbox = { min = [" << x
            << ", 0, " << z << "], max = [" << x + width << ", " << depth << ", " << z + height << "] }\n";
        if (fixed) out << "fixed = true\n";
    }
    void floor(double length) { box(-1, -1, length + 2, 1, 1, true); }
};

void stack(Text& text, Draw& draw, bool wet) {
    text.strength(draw, 15, 45);
    const int columns = draw.one(wet ? 2 : 1, 6), rows = draw.one(1, 6);
    const double height = draw.between(0.08, 0.3);
    text.out << "[[stack]]\ncolumns = " << columns << "\nrows = " << rows << "\nslices = " << draw.one(1, 2)
             << "\nblock = [" << draw.between(0.1, 0.4) << ", " << draw.between(0.1, 0.4) << ", " << height
             << "]\n";
    if (!wet) return;
    text.out << "[[water]]\nfissure = " << draw.one(1, columns - 1)
             << "\ndepth = " << draw.between(0.1, 0.7) * rows * height << "\n";
}

void column(Text& text, Draw& draw, double x, double base, double width, double depth) {
    const double height = draw.between(1, 5) * width;
    const int pieces = draw.one(1, 4);
    for (int k = 0; k < pieces; ++k) text.box(x, base + height * k / pieces, width, height / pieces, depth);
}

void columns(Text& text, Draw& draw) {
    text.strength(draw, 20, 50);
    text.floor(4);
    const double depth = draw.between(0.2, 1);
    double x = 0;
    for (int left = draw.one(1, 5); left > 0; --left) {
        const double width = draw.between(0.15, 0.5);
        column(text, draw, x, 0, width, depth);
        x += width;
    }
}

void steps(Text& text, Draw& draw) {
    text.strength(draw, 25, 45);
    const double width = draw.between(0.3, 1), rise = draw.between(0.05, 0.3) * width;
    const int count = draw.one(2, 6);
    text.box(-width, -1, width, 1, 1, true);
    for (int k = 0; k < count; ++k) text.box(k * width, -1, width, 1 + k * rise, 1, true);
    for (int k = 0; k < count; ++k) column(text, draw, k * width, k * rise, width, 1);
}

void wall(Text& text, Draw& draw) {
    text.strength(draw, 25, 50);
    constexpr double kNone = 1e-9;  // [m]: rounding leaves that at the end of a row
    const double length = draw.between(1, 3), shortest = 0.25;
    text.floor(length);
    double z = 0;
    for (int rows = draw.one(2, 6), k = 0; k < rows; ++k) {
        const double height = draw.between(0.2, 0.5), end = length - (k > 0 ? draw.between(0, 0.3) : 0);
        double x = k > 0 ? draw.between(0, 0.3) : 0;
        while (end - x > kNone) {
            const double left = end - x, wanted = draw.between(shortest, 1.2);
            const double width = left - wanted < shortest ? left : wanted;
            text.box(x, z, width, height, 0.4);
            x += width;
        }
        z += height;
    }
}

void arch(Text& text, Draw& draw) {
    text.strength(draw, 35, 50, 1e10);
    text.out.precision(12);  // neighbours share their faces
    const int count = 2 * draw.one(3, 10) + 1;
    const double radius = draw.between(2, 10), half = draw.between(60, 90) * kDegree;
    const double thickness = draw.between(0.11, 0.25) * radius;
    const auto voussoir = [&](double from, double to, bool fixed) {
        text.out << "[[block]]\nname = \"" << (fixed ? "abutment" : "v") << ++text.blocks
                 << "\"\nvertices = [";
        for (const double y : {0.0, 1.0})
            for (const double angle : {from, to})
                for (const double r : {radius - thickness / 2, radius + thickness / 2})
                    text.out << "[" << r * std::sin(angle) << ", " << y << ", " << r * std::cos(angle)
                             << "], ";
        text.out << "]\n" << (fixed ? "fixed = true\n" : "");
    };
    const double wide = 2 * half / count;
    voussoir(-half - wide, -half, true);
    for (int k = 0; k < count; ++k) voussoir(-half + k * wide, -half + (k + 1) * wide, false);
    voussoir(half, half + wide, true);
}

void wedge(Text& text, Draw& draw) {
    text.strength(draw, 30, 50);
    text.out << "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [10, 10, 10] } }\n"
                "names = { wedge = [5.0, 2.0, 9.0] }\nfixed = [{ joint = \"A\" }, { joint = \"B\" }]\n";
    const auto plane = [&](const char* name, double dip, double direction) {
        text.out << "[[single_joint]]\nname = \"" << name << "\"\npoint = [5, 0, 3]\ndip_deg = " << dip
                 << "\ndip_direction_deg = " << direction << "\n";
    };
    plane("A", draw.between(20, 55), draw.between(115, 150));
    plane("B", draw.between(20, 55), draw.between(210, 245));
}

void rockSlope(Text& text, Draw& draw) {
    text.strength(draw, 30, 50, 1e10);
    const double height = draw.between(5, 15), slope = draw.between(50, 75);
    const double crest = height / std::tan(slope * kDegree), back = crest + height;
    const double below = 0.2 * height, spacing = draw.between(0.25, 0.4) * height;
    text.out << "[rock_mass]\nregion = { profile = [[" << -below << ", " << -below << "], [" << back << ", "
             << -below << "], [" << back << ", " << height << "], [" << crest << ", " << height
             << "], [0, 0], [" << -below << ", 0]], y = [0, " << spacing * draw.one(1, 2)
             << "] }\nmin_thickness = " << 0.02 * height
             << "\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }, { plane = { point = [0, 0, 0], "
                "dip_deg = "
             << draw.between(5, 30) << ", dip_direction_deg = 270 } }]\n";
    const auto set = [&](const char* name, double dip, double direction) {
        text.out << "[[joint_set]]\nname = \"" << name << "\"\ndip_deg = " << dip
                 << "\ndip_direction_deg = " << direction
                 << "\nspacing = " << spacing * draw.between(0.7, 1.3) << "\n";
    };
    set("bedding", draw.between(5, 30), draw.one(0, 1) * 180 + draw.between(80, 100));
    set("J1", draw.between(65, 90), draw.between(80, 100));
    if (draw.one(0, 1)) set("J2", draw.between(75, 90), draw.between(-10, 10) + 10);
}

}  // namespace

const char* nameOf(ModelKind kind) {
    switch (kind) {
        case ModelKind::stack:
            return "stack";
        case ModelKind::wet_stack:
            return "wet stack";
        case ModelKind::columns:
            return "columns";
        case ModelKind::wall:
            return "wall";
        case ModelKind::arch:
            return "arch";
        case ModelKind::wedge:
            return "wedge";
        case ModelKind::steps:
            return "steps";
        case ModelKind::rock_slope:
            break;
    }
    return "rock slope";
}

std::string drawnScenario(ModelKind kind, unsigned seed) {
    Draw draw(seed * 8191u + static_cast<unsigned>(kind) + 1u);
    Text text;
    switch (kind) {
        case ModelKind::stack:
            stack(text, draw, false);
            break;
        case ModelKind::wet_stack:
            stack(text, draw, true);
            break;
        case ModelKind::columns:
            columns(text, draw);
            break;
        case ModelKind::wall:
            wall(text, draw);
            break;
        case ModelKind::arch:
            arch(text, draw);
            break;
        case ModelKind::wedge:
            wedge(text, draw);
            break;
        case ModelKind::steps:
            steps(text, draw);
            break;
        case ModelKind::rock_slope:
            rockSlope(text, draw);
            break;
    }
    return text.out.str();
}

}  // namespace talus::test
