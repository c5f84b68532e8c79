#pragma once
// Plots and drawings as data: the page draws them (page/), svg.h writes them as files for documents.
// README.md gives the row of each kind of series.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/json_fwd.h"

namespace talus::tools {

struct Spot {
    double x = 0, y = 0;
};

/// A series, with a colour and symbol by its role ("dem", "laboratory", "theory", "band", ...).
struct Series {
    std::string type, role, name;  ///< no name: not in the legend
    std::vector<std::vector<double>> rows;
    std::vector<std::string> tips{};  ///< of each row, or none at all; the texts themselves for "labels"
    std::string symbol = "circle";    ///< of points: circle, triangle, square
    double size = 5, shift = 0;       ///< radius, and how far the symbols stand to the right of their x [px]
    bool right = false;               ///< over Plot::right

    void add(std::vector<double> row) { rows.push_back(std::move(row)); }
    void add(std::vector<double> row, std::string tip) {
        rows.push_back(std::move(row));
        tips.push_back(std::move(tip));
    }
};

/// A line across the plot, or a zone of it.
struct Reference {
    char axis = 'y';  ///< at which `at` is a value
    double at = 0;
    std::optional<double> to;  ///< a zone up to here
    std::string role, name{};  ///< no name: not in the legend
    std::string text{};        ///< beside the line
    bool below = false;        ///< the text
};

/// An axis over `domain`, or over the data and up to round numbers when it is empty; or over names, which
/// stand at 0, 1, 2, ...
struct PlotAxis {
    std::string title;
    std::vector<double> domain{};
    double step = 0;    ///< between ticks; 0: chosen by the page
    int decimals = -1;  ///< of tick labels; -1: as many as they need
    std::vector<std::string> categories{};
    bool first_on_top = false;
    bool logarithmic = false;  ///< drawn by svg.h only; `domain` is given and positive
};

struct Plot {
    std::string id, title, description;
    PlotAxis x, y;
    std::vector<Series> series{};
    std::vector<Reference> references{};
    std::vector<Series> key{};        ///< further entries of the legend: type, role and name
    std::optional<PlotAxis> right{};  ///< a second y axis; drawn by svg.h only, and `domain` is given
};

/// An outline of a side view, in metres, y upwards.
struct Shape {
    std::string role;
    std::vector<Spot> spots;
    std::string tip{};
    bool open = false;  ///< a line
};

struct Link {
    std::string href, text;  ///< a path from the page's folder
};

/// A side view, to scale.
struct Drawing {
    std::string title, description;  ///< text for screen readers
    std::vector<Shape> shapes{};
    std::optional<std::pair<Spot, std::string>> label{};
    std::string caption_title{}, caption{};
    std::vector<Link> links{};
};

Json toJson(const Plot& plot);
Json toJson(const Drawing& drawing);

}  // namespace talus::tools
