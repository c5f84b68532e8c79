// The scenario files of this repository: all of them are good, and the paper's describe the paper's slope.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "scenario_texts.h"

namespace talus::formats {

namespace {

const std::filesystem::path kBench = std::filesystem::path(TALUS_SOURCE_DIR) / "bench";
constexpr double kDeg = 3.14159265358979323846 / 180;

Scenario readFile(const std::filesystem::path& path) {
    auto scenario = readScenario(path.string());
    for (const Error& error : scenario.errors()) FAIL_CHECK(format(error));
    REQUIRE(scenario.ok());
    return *scenario;
}

/// Numbers of the fissures that hold water, by the plane their walls lie in.
std::set<int> wateredFissures(const Model& model) {
    std::set<int> fissures;
    for (const Water& water : model.waters)
        for (const WetFace& wall : water.walls) {
            const Polyhedron& shape = model.blocks[static_cast<std::size_t>(wall.block)].shape;
            fissures.insert(static_cast<int>(
                std::lround(shape.faceCentroid(static_cast<std::size_t>(wall.face)).x() / 0.2)));
        }
    return fissures;
}

void checkPaperSlope(const std::string& name, int columns, int slices, const std::set<int>& fissures) {
    CAPTURE(name);
    const Model model = readFile(kBench / "paper" / name).model;
    REQUIRE(model.stack.has_value());
    CHECK(model.stack->columns == columns);
    CHECK(model.stack->rows == 5);
    CHECK(model.stack->slices == slices);
    CHECK(model.stack->block == Vec3(0.2, 0.1, 0.1));
    CHECK(model.blocks.size() == static_cast<std::size_t>(1 + columns * 5 * slices));
    CHECK(model.blocks[1].density == 2700);
    REQUIRE(model.joints.size() == 1);
    CHECK(model.joints[0].normal_stiffness == 3.375e11);
    CHECK(model.joints[0].shear_stiffness == 3.375e11);
    CHECK(model.joints[0].friction == doctest::Approx(19.5 * kDeg));
    CHECK(model.joints[0].cohesion == 0);
    CHECK(model.points.kind == PointRule::Kind::vertex);
    CHECK(model.waters.size() == fissures.size());
    CHECK(wateredFissures(model) == fissures);
    for (const Water& water : model.waters) {
        CHECK(water.kind == Water::Level::depth);
        CHECK(water.level.at(0).value == 0.35);
        CHECK(water.base == 0);
        CHECK(water.walls.size() == static_cast<std::size_t>(2 * 5 * slices));
    }
}

}  // namespace

TEST_CASE("scenario files of bench/: all are good") {
    struct Folder {
        std::string name;
        int least;  ///< files in it
    };
    for (const Folder& folder : {Folder{"paper", 10}, Folder{"examples", 8}, Folder{"verification", 10}}) {
        int count = 0;
        for (const auto& file : std::filesystem::directory_iterator(kBench / folder.name)) {
            if (file.path().extension() != ".toml") continue;
            CAPTURE(file.path().string());
            const Scenario scenario = readFile(file.path());
            const auto& blocks = scenario.model.blocks;
            CHECK(std::any_of(blocks.begin(), blocks.end(),
                              [](const Block& b) { return b.motion == Motion::free; }));
            ++count;
        }
        CHECK_MESSAGE(count >= folder.least, "too few files in bench/", folder.name);
    }
}

TEST_CASE("scenario files of bench/paper: the paper's slope") {
    checkPaperSlope("dry.toml", 7, 3, {});
    for (int fissure = 1; fissure <= 6; ++fissure)
        checkPaperSlope("fissure-" + std::to_string(fissure) + ".toml", 7, 3, {fissure});
    checkPaperSlope("section5-fissure-7.toml", 12, 3, {7});
    checkPaperSlope("section5-fissures-7-10.toml", 12, 3, {7, 8, 9, 10});
    checkPaperSlope("lp-study.toml", 7, 1, {});
}

TEST_CASE("scenario files of bench/verification: the blocks with water behind them") {
    struct Case {
        const char* shape;
        double width, height, friction_deg;
    };
    for (const Case& c : {Case{"1x1", 1, 1, 40}, Case{"1x2", 1, 2, 40}, Case{"0.5x1", 0.5, 1, 30}})
        for (const auto& [water, share] :
             {std::pair("dry", 0.0), std::pair("half-full", 0.5), std::pair("full", 1.0)}) {
            const std::string name = std::string("water-behind-") + c.shape + "-" + water + ".toml";
            CAPTURE(name);
            const Model model = readFile(kBench / "verification" / name).model;
            CHECK(model.joints[0].friction == doctest::Approx(c.friction_deg * kDeg));
            CHECK(model.blocks[1].density * 9.81 == doctest::Approx(26000).epsilon(1e-9));
            const MassProperties mass = massProperties(model.blocks[1].shape);
            CHECK(mass.volume == doctest::Approx(c.width * c.height));
            CHECK(mass.centroid.z() == doctest::Approx(c.height / 2));
            CHECK(model.waters.size() == (share > 0 ? 1 : 0));
            if (share > 0) CHECK(model.waters[0].level[0].value == doctest::Approx(share * c.height));
        }
}

}  // namespace talus::formats
