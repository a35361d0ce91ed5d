// SPDX-License-Identifier: MIT
#include "app/cost_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "io/file.h"
#include "ui/false_color.h"

namespace lodestar::app {
namespace {

/// What a table of choices offers, relative RMSE.
constexpr double kTolerances[] = {0.2, 0.1, 0.05, 0.02};

/// Exponents that behave alike.
struct Band {
    const char* name;
    double low, high;
};
constexpr Band kBands[] = {{"broad, exponents up to 10", 0.0, 10.0},
                           {"glossy, 10 to 150", 10.0, 150.0},
                           {"sharp, beyond 150", 150.0, 1e9}};

constexpr const char* kStyle = R"(<style>
body{font:16px/1.5 system-ui,sans-serif;color:#222;background:#fff;max-width:72em;margin:2em auto;padding:0 1.5em}
h1{font-size:1.7em;margin-bottom:.2em}h2{font-size:1.25em;margin-top:2em;border-bottom:1px solid #ddd;padding-bottom:.2em}
p.lead{font-size:1.05em;max-width:50em}.muted{color:#666}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}th,td{padding:.25em .8em;text-align:right;border-bottom:1px solid #eee}
th{font-weight:600;background:#f6f6f6}th:first-child,td:first-child{text-align:left}tr.front td{background:#fdf3e4}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(22em,1fr));gap:1em}.plots figure,.maps figure{margin:0}.plots svg{width:100%;height:auto}
.maps{display:flex;flex-wrap:wrap;gap:.8em}.maps img{width:21em;max-width:100%;image-rendering:auto;display:block}
figcaption{font-size:.85em;color:#555}.legend{display:flex;align-items:center;gap:.6em;margin:.6em 0}
.legend i{display:block;width:16em;height:1em}details{margin-top:1em}summary{cursor:pointer}
.scroll{overflow-x:auto}
</style>)";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char character : text) {
        switch (character) {
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '&':
            out += "&amp;";
            break;
        case '"':
            out += "&quot;";
            break;
        default:
            out += character;
        }
    }
    return out;
}

std::string format(const char* pattern, double value) {
    char text[64];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
}

std::string percent(double share) {
    return std::isfinite(share) ? format(share < 0.01 ? "%.2f" : "%.1f", 100.0 * share) + " %"
                                : std::string("&infin;");
}

std::string base64(const io::Bytes& bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (k < count ? bytes[i + k] : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
        }
    }
    return text;
}

struct Choice {
    std::string estimator;
    double ms = 0.0;
};

/// The fastest estimator whose error is within a tolerance at every exponent of a band.
Choice cheapest(const CostTable& table, const std::string& environment, const Band& band,
                double tolerance) {
    struct Sum {
        std::string estimator;
        double worst = 0.0, ms = 0.0;
        int count = 0;
    };
    std::vector<Sum> sums;
    for (const CostRow& row : table.rows) {
        if (row.environment != environment || row.term != "glossy" ||
            !(row.exponent >= band.low && row.exponent < band.high)) {
            continue;
        }
        if (sums.empty() || sums.back().estimator != row.estimator) {
            sums.push_back({row.estimator});
        }
        sums.back().worst = std::max(sums.back().worst, row.rmse);
        sums.back().ms += row.shadingMs;
        ++sums.back().count;
    }
    Choice best;
    for (const Sum& sum : sums) {
        const double ms = sum.ms / sum.count;
        if (sum.worst <= tolerance && (best.estimator.empty() || ms < best.ms)) {
            best = {sum.estimator, ms};
        }
    }
    return best;
}

bool hasExponents(const CostTable& table, const Band& band) {
    return std::any_of(table.exponents.begin(), table.exponents.end(),
                       [&](double s) { return s >= band.low && s < band.high; });
}

std::string choicesTable(const CostTable& table, const std::string& environment) {
    std::ostringstream html;
    html << "<div class=scroll><table><tr><th>surface</th>";
    for (const double tolerance : kTolerances) {
        html << "<th>within " << 100.0 * tolerance << " %</th>";
    }
    html << "</tr>";
    for (const Band& band : kBands) {
        if (!hasExponents(table, band)) {
            continue;
        }
        html << "<tr><td>" << band.name << "</td>";
        for (const double tolerance : kTolerances) {
            const Choice choice = cheapest(table, environment, band, tolerance);
            html << "<td>"
                 << (choice.estimator.empty() ? std::string("none")
                                              : "<b>" + escaped(choice.estimator) + "</b><br>" +
                                                    format("%.1f ms", choice.ms))
                 << "</td>";
        }
        html << "</tr>";
    }
    html << "</table></div>";
    return html.str();
}

std::string rowsTable(const CostTable& table, const std::string& environment) {
    std::ostringstream html;
    html << "<details><summary>All figures of " << escaped(environment)
         << " (coloured: nothing is faster and as right)</summary><div class=scroll><table>"
            "<tr><th>estimator</th><th>term</th><th>exponent</th><th>fetches</th><th>RMSE</th>"
            "<th>worst</th><th>ms a megapixel</th></tr>";
    for (const CostRow& row : table.rows) {
        if (row.environment != environment) {
            continue;
        }
        html << (row.front ? "<tr class=front>" : "<tr>") << "<td>" << escaped(row.estimator)
             << "</td><td>" << row.term << "</td><td>" << row.exponent << "</td><td>" << row.fetches
             << "</td><td>" << percent(row.rmse) << "</td><td>" << percent(row.worst) << "</td><td>"
             << format("%.2f", row.shadingMs) << "</td></tr>";
    }
    html << "</table></div></details>";
    return html.str();
}

std::string preparationsTable(const CostTable& table) {
    std::ostringstream html;
    html << "<h2>Before the first pixel</h2><div class=scroll><table><tr><th>estimator</th>"
            "<th>term</th><th>map</th><th>made in</th><th>memory</th></tr>";
    for (const CostPreparation& made : table.preparations) {
        html << "<tr><td>" << escaped(made.estimator) << "</td><td>" << made.term << "</td><td>"
             << escaped(made.environment) << "</td><td>" << format("%.0f ms", made.ms)
             << "</td><td>" << format("%.0f KB", static_cast<double>(made.bytes) / 1024.0)
             << "</td></tr>";
    }
    html << "</table></div>";
    return html.str();
}

std::string lobesTable(const CostTable& table) {
    std::ostringstream html;
    html << "<h2>Forms of direct light's lobe</h2><p>A black surface of F0 = 0.04 under lights all "
            "over its hemisphere, seen at n.v = 1, 0.7 and 0.3, against (n.h)^s and Schlick's form "
            "in "
            "double precision: the root mean square of the difference over that of the truth, and "
            "the greatest over the peak. The time is of a tile under "
         << kCostedLights
         << " lights.</p><div class=scroll><table><tr><th>lobe</th><th>Fresnel</th>"
            "<th>exponent</th><th>RMSE</th><th>worst</th><th>ms a megapixel</th></tr>";
    for (const CostLobe& row : table.lobes) {
        html << "<tr><td>" << row.lobes << "</td><td>" << row.fresnel << "</td><td>" << row.exponent
             << "</td><td>" << percent(row.rmse) << "</td><td>" << percent(row.worst) << "</td><td>"
             << format("%.2f", row.shadingMs) << "</td></tr>";
    }
    html << "</table></div>";
    return html.str();
}

std::string legend(double most) {
    std::string stops;
    for (int i = 0; i <= 12; ++i) {
        const glm::vec3 color = 255.0f * ui::falseColor(i / 12.0);
        char text[40];
        std::snprintf(text, sizeof text, "%srgb(%.0f,%.0f,%.0f)", i > 0 ? "," : "",
                      static_cast<double>(color.r), static_cast<double>(color.g),
                      static_cast<double>(color.b));
        stops += text;
    }
    return "<div class=legend>0 %<i style=\"background:linear-gradient(90deg," + stops +
           ")\"></i>" + format("%.0f", 100.0 * most) +
           " % of the map's own brightness (RMS) or more</div>";
}

core::Result<std::string> embedded(const std::filesystem::path& file) {
    const auto bytes = io::readFile(file);
    if (!bytes) {
        return core::inFile(bytes.error(), file.string());
    }
    return "data:image/png;base64," + base64(*bytes);
}

core::Result<std::string> plotOf(const CostPlot& plot) {
    const auto bytes = io::readFile(plot.file);
    if (!bytes) {
        return core::inFile(bytes.error(), plot.file.string());
    }
    const std::string text(bytes->begin(), bytes->end());
    const std::size_t svg = text.find("<svg");
    return "<figure>" + text.substr(svg == std::string::npos ? 0 : svg) + "<figcaption>" +
           escaped(plot.title) + "</figcaption></figure>";
}

std::string head(const CostTable& table) {
    std::ostringstream html;
    html << "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
            "content=\"width=device-width\"><title>What accuracy costs</title>"
         << kStyle << "<h1>What accuracy costs in time</h1><p class=muted>Shaded by "
         << escaped(table.renderer) << "; cubes of " << table.width << " texels a side; "
         << table.directions << " directions a map.</p>";
    for (const std::string& sentence : costConclusion(table)) {
        html << "<p class=lead>" << escaped(sentence) << "</p>";
    }
    return html.str();
}

constexpr const char* kMethod =
    "<h2>How it was measured</h2><p>The truth is the mean radiance over the Phong lobe, in double "
    "precision over the map's texels with their exact solid angles. Errors are relative: the root "
    "mean square of the difference over the sphere and rgb, over that of the truth; <i>worst</i> "
    "is "
    "the greatest difference of one direction over the same. Half of the directions are spread "
    "evenly, half seek the map's bright parts; each counts for the solid angle that it stands "
    "for. Times are of a tile of balls on which this one lookup is shaded, the least of a few "
    "repeats, a tile's own cost included. <i>rsrm</i> maps hold the mean over azimuth: on a "
    "panorama that is not symmetric about the zenith they cannot be right, and are not meant for "
    "it.</p>";

} // namespace

std::vector<std::string> costConclusion(const CostTable& table) {
    std::vector<std::string> sentences;
    for (const std::string& environment : table.environments) {
        std::string sentence = "On " + environment;
        std::string last;
        for (auto t = std::rbegin(kTolerances); t != std::rend(kTolerances); ++t) {
            const Choice choice = cheapest(table, environment, {"all", 0.0, 1e9}, *t);
            if (choice.estimator.empty() || choice.estimator == last) {
                continue; // a tighter tolerance has named it
            }
            sentence +=
                (last.empty() ? " the fastest glossy estimator that stays within " : ", within ") +
                format("%.0f %% is ", 100.0 * *t) + choice.estimator +
                format(" (%.1f ms a megapixel)", choice.ms);
            last = choice.estimator;
        }
        sentences.push_back(
            !last.empty() ? sentence + ", at every exponent measured."
                          : sentence + " no glossy estimator stays within 20 % at every "
                                       "exponent; the table by surface says what does where.");
    }
    return sentences;
}

core::Result<std::string> costPage(const CostTable& table, const std::vector<CostPlot>& plots,
                                   const std::vector<std::filesystem::path>& pictures) {
    std::ostringstream html;
    html << head(table)
         << "<h2>Which estimator is good enough</h2><p>The fastest whose error "
            "stays within a tolerance at every exponent of a row.</p>";
    for (const std::string& environment : table.environments) {
        html << "<p><b>" << escaped(environment) << "</b></p>" << choicesTable(table, environment);
    }
    if (!plots.empty()) {
        html << "<h2>Error against cost</h2><div class=plots>";
        for (const CostPlot& plot : plots) {
            const auto figure = plotOf(plot);
            if (!figure) {
                return figure.error();
            }
            html << *figure;
        }
        html << "</div>";
    }
    html << "<h2>Where the errors are</h2><p>Up is up, the middle looks along -Z.</p>"
         << legend(kPictureMost) << "<div class=maps>";
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const CostPicture& picture = table.pictures[i];
        const auto data = embedded(pictures[i]);
        if (!data) {
            return data.error();
        }
        const std::string caption = escaped(picture.environment + ": " + picture.estimator) +
                                    format(", exponent %g", picture.exponent);
        html << "<figure><img alt=\"" << caption << "\" src=\"" << *data << "\"><figcaption>"
             << caption << "</figcaption></figure>";
    }
    html << "</div>" << preparationsTable(table) << lobesTable(table) << kMethod
         << "<h2>Figures</h2>";
    for (const std::string& environment : table.environments) {
        html << rowsTable(table, environment);
    }
    html << "</html>\n";
    return html.str();
}

} // namespace lodestar::app
