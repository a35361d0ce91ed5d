// SPDX-License-Identifier: MIT
#include "app/cost_plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>

namespace lodestar::app {
namespace {

/// An estimator over all exponents of a map.
struct Summary {
    std::string estimator;
    int fetches = 0;
    double rmse = 0.0; ///< root mean square over exponents
    double ms = 0.0;   ///< mean
};

std::vector<Summary> summaries(const CostTable& table, const std::string& environment) {
    std::vector<Summary> all;
    for (const CostRow& row : table.rows) {
        if (row.environment != environment || row.term != "glossy") {
            continue;
        }
        if (all.empty() || all.back().estimator != row.estimator) {
            all.push_back({row.estimator, row.fetches, 0.0, 0.0});
        }
        all.back().rmse += row.rmse * row.rmse;
        all.back().ms += row.shadingMs;
    }
    const auto count = static_cast<double>(table.exponents.size());
    for (Summary& summary : all) {
        summary.rmse = 100.0 * std::sqrt(summary.rmse / count);
        summary.ms /= count;
    }
    return all;
}

/// As gnuplot's text in single quotes.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char character : text) {
        out += character == '\'' ? std::string("''") : std::string(1, character);
    }
    return out + "'";
}

std::string head(const std::filesystem::path& file) {
    return "set terminal svg size 660,420 dynamic enhanced font 'sans-serif,15' background "
           "rgb 'white'\nset output " +
           quoted(file.string()) +
           "\nset grid lc rgb '#dddddd'\nset border 3 lc rgb '#555555'\nset tics nomirror\n"
           "set logscale y\nset ylabel 'relative RMSE, %'\nset key outside right top noenhanced\n";
}

/// One dataset an estimator, so that each has the same mark in every plot.
std::string marks(const std::vector<Summary>& all, bool fetches) {
    std::ostringstream data;
    std::ostringstream plot;
    for (std::size_t i = 0; i < all.size(); ++i) {
        data << "$mark" << i << " << EOD\n"
             << (fetches ? static_cast<double>(all[i].fetches) : all[i].ms) << ' '
             << std::max(all[i].rmse, 1e-3) << "\nEOD\n";
        plot << (i > 0 ? ", " : "") << "$mark" << i << " using 1:2 with points pt " << i % 15 + 1
             << " ps 1 lw 1.8 lc " << i + 1 << " title " << quoted(all[i].estimator);
    }
    return data.str() + "plot " + plot.str();
}

std::string againstFetches(const std::vector<Summary>& all) {
    return "set logscale x 2\nset xlabel 'texture fetches a pixel'\nset xrange [0.7:96]\n" +
           marks(all, true) + "\n";
}

/// Those that no other beats, from the fastest.
std::vector<Summary> front(std::vector<Summary> all) {
    std::sort(all.begin(), all.end(), [](const Summary& a, const Summary& b) {
        return a.ms != b.ms ? a.ms < b.ms : a.rmse < b.rmse;
    });
    std::vector<Summary> best;
    for (const Summary& one : all) {
        if (best.empty() || one.rmse < best.back().rmse) {
            best.push_back(one);
        }
    }
    return best;
}

std::string againstMilliseconds(const std::vector<Summary>& all) {
    std::ostringstream text;
    text << "$front << EOD\n";
    for (const Summary& one : front(all)) {
        text << one.ms << ' ' << std::max(one.rmse, 1e-3) << '\n';
    }
    text << "EOD\nset logscale x\nset xlabel 'milliseconds a megapixel'\n"
            "set offsets graph 0.1, graph 0.1, graph 0.05, graph 0.05\n"
         << marks(all, false)
         << ", $front using 1:2 with steps lw 1.2 lc rgb '#bbbbbb' title 'Pareto front'\n";
    return text.str();
}

std::string againstExponent(const CostTable& table, const std::string& environment) {
    std::vector<std::string> names;
    std::map<std::string, std::ostringstream> data;
    for (const CostRow& row : table.rows) {
        if (row.environment == environment && row.term == "glossy") {
            if (data.find(row.estimator) == data.end()) {
                names.push_back(row.estimator);
            }
            data[row.estimator] << row.exponent + 1.0 << ' ' << std::max(100.0 * row.rmse, 1e-3)
                                << '\n';
        }
    }
    std::ostringstream text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text << "$data" << i << " << EOD\n" << data[names[i]].str() << "EOD\n";
    }
    text << "set logscale x 2\nset xlabel 'Phong exponent + 1'\nplot ";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text << (i > 0 ? ", " : "") << "$data" << i << " using 1:2 with linespoints pt "
             << i % 15 + 1 << " ps 0.7 lw 1.5 lc " << i + 1 << " title " << quoted(names[i]);
    }
    text << '\n';
    return text.str();
}

core::Result<void> draw(const std::string& commands, const std::filesystem::path& file) {
    std::FILE* gnuplot = popen("gnuplot 2>/dev/null", "w");
    const bool written = gnuplot != nullptr && std::fwrite(commands.data(), 1, commands.size(),
                                                           gnuplot) == commands.size();
    if (gnuplot == nullptr || pclose(gnuplot) != 0 || !written) {
        return core::Error{
            core::ErrorCode::OutputFailed, "gnuplot could not draw it", file.string(), {}};
    }
    return {};
}

} // namespace

bool canPlot() {
    return std::system("gnuplot --version >/dev/null 2>&1") == 0;
}

core::Result<std::vector<CostPlot>> plotCost(const CostTable& table,
                                             const std::filesystem::path& folder) {
    std::vector<CostPlot> plots;
    for (std::size_t i = 0; i < table.environments.size(); ++i) {
        const std::string& environment = table.environments[i];
        const std::vector<Summary> all = summaries(table, environment);
        const std::pair<const char*, std::string> wanted[] = {
            {"fetches", againstFetches(all)},
            {"milliseconds", againstMilliseconds(all)},
            {"exponent", againstExponent(table, environment)}};
        for (const auto& [name, commands] : wanted) {
            const std::filesystem::path file =
                folder / ("error-" + std::to_string(i + 1) + "-" + name + ".svg");
            if (auto drawn = draw(head(file) + commands, file); !drawn) {
                return drawn.error();
            }
            plots.push_back({environment + ": error against " + name, file});
        }
    }
    return plots;
}

} // namespace lodestar::app
