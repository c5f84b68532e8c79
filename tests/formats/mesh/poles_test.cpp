// Tables of planes: notations, titles, separators, decimal commas, and faults where they are.

#include "talus/formats/poles.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/files.h"
#include "talus/formats/fractures.h"
#include "talus/formats/scenario.h"
#include "talus/rock_mass.h"

using namespace talus;
using namespace talus::formats;

namespace {

constexpr double kDeg = std::numbers::pi / 180;

Vec3 plane(double dip, double dip_direction) { return upwardNormal(dip * kDeg, dip_direction * kDeg); }

PoleTable good(const std::string& text) {
    const auto table = parsePoles(text, "poles.csv");
    if (!table) FAIL(format(table.errors()[0]));
    return *table;
}

void checkOne(const std::string& text, const Vec3& normal) {
    const PoleTable table = good(text);
    REQUIRE(table.poles.size() == 1);
    CAPTURE(text);
    CHECK((table.poles[0].normal - normal).norm() < 1e-12);
}

/// The first fault begins with this place and holds this text.
void checkFault(const std::string& text, const std::string& place, const std::string& fragment) {
    const auto table = parsePoles(text, "p.csv");
    CAPTURE(text);
    REQUIRE_FALSE(table.ok());
    const std::string said = format(table.errors()[0]);
    CHECK_MESSAGE(said.starts_with("p.csv:" + place + ": error: "), said);
    CHECK_MESSAGE(said.find(fragment) != std::string::npos, said);
}

}  // namespace

TEST_CASE("poles: one plane in each notation") {
    const Vec3 normal = plane(40, 135);
    checkOne("dip_deg,dip_direction_deg\n40,135\n", normal);
    checkOne("strike_deg,dip_deg\n45,40\n", normal);
    checkOne("strike,dip\nN45E,40SE\n", normal);
    checkOne("strike,dip\nS45W,40 se\n", normal);
    checkOne("strike,dip\n225,40S\n", normal);
    checkOne("trend_deg,plunge_deg\n315,50\n", normal);
    checkOne("dip,strike\n40NW,N45E\n", plane(40, 315));
    checkOne("strike,dip\nN30W,60NE\n", plane(60, 60));
    checkOne("strike,dip\n350,20\n", plane(20, 80));
    char row[128];
    std::snprintf(row, sizeof row, "nx,ny,nz\n%.17g,%.17g,%.17g\n", -3 * normal.x(), -3 * normal.y(),
                  -3 * normal.z());
    checkOne(row, normal);  // of any length and sign
}

TEST_CASE("poles: titles as people write them, in any order, with others between") {
    for (const char* header :
         {"Dip,Dip Direction", "DIP (deg),Dip Dir. (°)", "dip angle,dipdir", "Dip_deg;DD", "dip\tdip azimuth",
          "\xef\xbb\xbf"
          "dip [deg],dip-direction [degrees]"}) {
        const char separator = std::string(header).find(';') != std::string::npos    ? ';'
                               : std::string(header).find('\t') != std::string::npos ? '\t'
                                                                                     : ',';
        checkOne(std::string(header) + "\n40" + separator + "135\n", plane(40, 135));
    }
    const PoleTable table =
        good("# face 3\nID;Dip Direction;Set;Dip;Remarks\n1;135;J1;40;rough\n\n2;120;J2;35;\n");
    CHECK(table.notation == "dip_deg, dip_direction_deg");
    CHECK(table.has_sets);
    CHECK(table.poles[0].set == "J1");
    CHECK(table.poles[1].set == "J2");
    CHECK(table.passed_over == std::vector<std::string>{"ID", "Remarks"});
}

TEST_CASE("poles: decimal commas where commas do not part the columns, degree signs") {
    checkOne("dip;dip direction\n40,5;135,25\n", plane(40.5, 135.25));
    checkOne("dip\tdip direction\n40,5\t135,25\n", plane(40.5, 135.25));
    checkOne("dip,dip direction\n40.5°,135.25\n", plane(40.5, 135.25));
    checkFault("dip,dip direction\n40,5,135,25\n", "2", "found 4 values, allowed: 2");
}

TEST_CASE("poles: weights, spacings, scanlines and quantities") {
    CHECK(good("dip,dd,weight\n40,135,2.5\n").poles[0].weight == 2.5);
    CHECK(good("dip,dd,spacing_m\n40,135,0.4\n").poles[0].spacing == 0.4);
    const PoleTable table = good("dip,dd,scanline_trend_deg,scanline_plunge_deg\n40,135,90,30\n");
    REQUIRE(table.poles[0].scanline);
    CHECK((*table.poles[0].scanline - Vec3(std::cos(30 * kDeg), 0, -0.5)).norm() < 1e-15);
    CHECK(good("dip,dd,quantity\n40,135,3\n50,100,1\n").poles.size() == 4);
    checkFault("dip,dd,quantity\n40,135,1.5\n", "2:8", "a whole one");
    checkFault("dip,dd,weight,spacing_m\n40,135,1,1\n", "1", "found more than one of weight, spacing_m");
    checkFault("dip,dd,scanline_trend\n40,135,1\n", "1", "both or none");
}

TEST_CASE("poles: two notations in one table have to agree") {
    checkOne("strike,dip,dip direction\n45,40,135\n", plane(40, 135));
    checkOne("strike,dip,dip direction\n45,40,136\n", plane(40, 136));  // rounded to whole degrees
    checkFault("strike,dip,dip direction\n45,40,315\n", "2:1",
               "found a plane by strike_deg, dip_deg that differs from the one by dip_deg");
}

TEST_CASE("poles: all faults are reported with their places") {
    CHECK(format(parsePoles("", "p.csv").errors()[0])
              .starts_with("p.csv: error: found no header, allowed: dip_deg"));
    checkFault("dip,dd\n", "1", "found no rows");
    checkFault("dip,azimuth\n40,135\n", "1",
               "found columns \"dip,azimuth\", allowed: dip_deg, dip_direction_deg, or strike_deg");
    checkFault("dip,strike (left)\n40,135\n", "1", "found columns");
    checkFault("dip,dip_deg,dd\n40,40,135\n", "1", "each once");
    checkFault("dip,dd\n94,135\n", "2:1", "found dip \"94\", allowed: a number of at least 0 and at most 90");
    checkFault("dip,dd\n40,135\n40, four\n", "3:5",
               "found dip_direction \"four\", allowed: a number of at least -360");
    checkFault("dip,dd\n40,\n", "2:4", "found dip_direction \"\"");
    checkFault("dip,dd\n40,nan\n", "2:4", "found dip_direction \"nan\"");
    checkFault("trend,plunge\n10,-5\n", "2:4", "found plunge \"-5\"");
    checkFault("nx,ny,nz\n0,0,0\n", "2:1", "found a normal of length 0");
    checkFault("strike,dip\nN45E,40\n", "2:6", "a dip with the side to which the plane dips, such as 45SE");
    checkFault("strike,dip\nN45E,40NE\n", "2:6", "with a side that is not the strike's own");
    checkFault("strike,dip\nN95E,40SE\n", "2:1", "found strike \"N95E\"");
    checkFault("dip,dd,weight\n40,135,0\n", "2:8", "greater than 0");
    const auto many = parsePoles("dip,dd\n95,1\n40,135\n96,1\n40\n", "p.csv");
    REQUIRE_FALSE(many.ok());
    CHECK(many.errors().size() == 3);
    CHECK(many.errors()[2].line == 5);
    CHECK_FALSE(readPoles("/nowhere/poles.csv").ok());
}

TEST_CASE("fractures: any notation of the plane, a diameter for the radius") {
    const auto discs = parseFractures("x;y;z;strike;dip;diameter_m\n1,5;2;3;45;40;4\n", "f.csv");
    REQUIRE(discs.ok());
    CHECK((*discs)[0].centre == Vec3(1.5, 2, 3));
    CHECK((*discs)[0].radius == 2);
    CHECK((*discs)[0].dip == doctest::Approx(40 * kDeg).epsilon(1e-14));
    CHECK((*discs)[0].dip_direction == doctest::Approx(135 * kDeg).epsilon(1e-14));
    const auto fault = [](const std::string& text) {
        return parseFractures(text, "f.csv").errors()[0].message;
    };
    CHECK(fault("x,y,z,dip,dd\n1,2,3,4,5\n").find("radius_m, diameter_m or trace_m") != std::string::npos);
    CHECK(fault("x,y,z,dip,dd,radius,diameter\n1,2,3,4,5,1,2\n").find("one of them") != std::string::npos);
    CHECK(fault("x,y,z,dip,dd,trace,diameter\n1,2,3,4,5,1,2\n") ==
          "found diameter_m and trace_m, allowed: one of them");
    CHECK(fault("x,y,dip,dd,radius\n1,2,3,4,5\n").find("allowed: x_m, y_m, z_m, and dip_deg") !=
          std::string::npos);
}

TEST_CASE("fractures: one disc in every notation, size and separator") {
    const std::string rows[] = {
        "x_m,y_m,z_m,dip_deg,dip_direction_deg,radius_m\n1.5,2,3,40,135,2.5\n",
        "trace_m;dip_deg;strike_deg;z_m;y_m;x_m\n5;40;45;3;2;1,5\n",
        "X\tY\tZ\tTrend (deg)\tPlunge (deg)\tDiameter (m)\n1,5\t2\t3\t315\t50\t5\n",
        "x,y,z,strike,dip,trace length (m)\n1.5,2,3,N45E,40SE,5\n",
        "x,y,z,nx,ny,nz,radius\n1.5,2,3,0.45451947767204,-0.45451947767204,0.76604444311898,2.5\n"};
    for (const std::string& text : rows) {
        CAPTURE(text);
        const auto discs = parseFractures(text, "f.csv");
        REQUIRE(discs.ok());
        REQUIRE(discs->size() == 1);
        CHECK((*discs)[0].centre == Vec3(1.5, 2, 3));
        CHECK((*discs)[0].radius == 2.5);
        CHECK((*discs)[0].dip == doctest::Approx(40 * kDeg).epsilon(1e-12));
        CHECK((*discs)[0].dip_direction == doctest::Approx(135 * kDeg).epsilon(1e-12));
    }
}

TEST_CASE("fractures: faults name line and column, what was found and what is allowed") {
    const auto fault = [](const std::string& text) {
        const auto discs = parseFractures(text, "f.csv");
        REQUIRE_FALSE(discs.ok());
        return format(discs.errors()[0]);
    };
    CHECK(fault("x,y,z,dip,dd,trace_m\n1,2,3,4,5,0\n") ==
          "f.csv:2:11: error: found trace \"0\", allowed: a number greater than 0 and at most 2000000");
    CHECK(fault("x;y;z;dip;dd;trace_m\n1,5;2;3;4;5;1,5\n1.5;2;3;95;5;1\n")
              .starts_with("f.csv:3:9: error: found dip \"95\", allowed: a number of at least 0"));
    CHECK(fault("x,y,z,strike,trace_m\n1,2,3,4,5\n").starts_with("f.csv:1: error: found columns"));
}
