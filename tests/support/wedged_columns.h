#pragma once
// Columns of 6, 2 and 6 blocks as a scenario: the low one wedges the tall ones as they slide, so that the
// answer depends on the loading path.

#include <string>

namespace talus::test {

inline std::string wedgedColumns(double tilt_deg = 0) {
    std::string text =
        "[gravity]\ntilt_deg = " + std::to_string(tilt_deg) +
        "\n[joint.default]\nnormal_stiffness = 3.375e11\nshear_stiffness = 3.375e11\n"
        "friction_deg = 28\n[material.rock]\ndensity = 2700.0\n"
        "[[block]]\nname = \"floor\"\nbox = { min = [-1, -1, -1], max = [2, 2, 0] }\nfixed = true\n";
    const int heights[] = {6, 2, 6};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < heights[c]; ++r) {
            const auto at = [](double x, double y, double z) {
                return "[" + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "]";
            };
            text += "[[block]]\nname = \"c" + std::to_string(c + 1) + "r" + std::to_string(r + 1) +
                    "\"\nbox = { min = " + at(0.2 * c, 0, 0.1 * r) +
                    ", max = " + at(0.2 * c + 0.2, 0.1, 0.1 * r + 0.1) + " }\n";
        }
    return text;
}

}  // namespace talus::test
