// SPDX-License-Identifier: MIT
//
// A program that edits, saves and autosaves without a pause is killed at random moments: what lies
// on the disk is a whole document of its history, and no more is lost than promised.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>

#include <poll.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include "model/document_file.h"
#include "model_support.h"
#include "support/fuzz.h"
#include "support/run.h"

namespace lodestar::model {
namespace {

namespace fs = std::filesystem;

/// How a session goes on, the same each time that it is asked. Its document is large enough that
/// writing takes a while.
class Session {
public:
    explicit Session(std::uint64_t seed) : random_(seed) {}

    static document::Document start() {
        document::Document document = documentOf(kDocument);
        std::vector<document::Stop>& stops = document.lights[0].keys[0].gradient.stops;
        stops.clear();
        for (int i = 0; i < 300; ++i) {
            stops.push_back({{90.0 - 0.6 * i, glm::dvec3(0.1 + 0.0005 * i), 0.0}, {}});
        }
        document.unknown = "{\"ballast\":\"" + std::string(std::size_t{1} << 18, 'x') + "\"}";
        return document;
    }
    /// Stroke number k says so in the document.
    Command next(const Model& model) {
        ++count_;
        now_ += std::uniform_real_distribution<double>(0.001, 0.6)(random_);
        const Id light = model.ids().lights[0].id;
        return SetLight{light, std::to_string(count_), {}, {}, {}, {}};
    }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] double now() const { return now_; }
    bool saves() { return std::uniform_int_distribution<int>(0, 30)(random_) == 0; }

private:
    std::mt19937_64 random_;
    int count_ = 0;
    double now_ = 0.0;
};

/// Edits until it is killed; tells each stroke that is done.
[[noreturn]] void editForever(const fs::path& path, std::uint64_t seed, int tell) {
    Model model;
    core::Tally warnings;
    auto file = DocumentFile::open(path, model, warnings);
    Session session(seed);
    while (file) {
        const bool done = model.execute(session.next(model)).ok();
        const double now = session.now();
        if (!done || ::write(tell, &now, sizeof now) != sizeof now || !file->autosave(model, now) ||
            (session.saves() && !file->save(model))) {
            break;
        }
    }
    ::_exit(1);
}

/// The stroke that a document stands after; what else it holds must be the session's.
int strokeOf(const document::Document& document, const document::Document& start) {
    const std::string& name = document.lights.at(0).name;
    document::Document same = start;
    same.lights[0].name = name;
    EXPECT_EQ(document, same);
    return name == "sky" ? 0 : std::stoi(name);
}

/// When a session is killed: so long after it began, or so long after the n-th temporary file.
struct Moment {
    int temporaries = 0; ///< 0: from the start
    std::chrono::microseconds wait{0};
};

/// Runs a session, kills it at a moment, and reads its clock at each stroke.
std::vector<double> killed(const fs::path& path, std::uint64_t seed, Moment moment) {
    int tell[2] = {-1, -1};
    EXPECT_EQ(::pipe(tell), 0);
    const int watch = ::inotify_init1(IN_NONBLOCK);
    EXPECT_GE(::inotify_add_watch(watch, path.parent_path().c_str(), IN_CREATE), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(tell[0]);
        editForever(path, seed, tell[1]);
    }
    ::close(tell[1]);
    std::vector<double> times = {0.0};
    double time = 0.0;
    const auto read = [&] {
        const bool more = ::read(tell[0], &time, sizeof time) == sizeof time;
        if (more) {
            times.push_back(time);
        }
        return more;
    };
    auto deadline = std::chrono::steady_clock::now() + moment.wait;
    bool lives = true;
    while (lives && (moment.temporaries > 0 || std::chrono::steady_clock::now() < deadline)) {
        pollfd ready[] = {{tell[0], POLLIN, 0}, {watch, POLLIN, 0}};
        ::poll(ready, 2, moment.temporaries > 0 ? 1000 : 0);
        if ((ready[1].revents & POLLIN) != 0) {
            alignas(inotify_event) char events[4096];
            static_cast<void>(!::read(watch, events, sizeof events));
            if (--moment.temporaries == 0) {
                deadline = std::chrono::steady_clock::now() + moment.wait;
            }
        }
        if (ready[0].revents != 0) { // read at once, so that the pipe never makes it wait
            lives = read();
        }
    }
    ::kill(child, SIGKILL);
    while (read()) {
    }
    ::close(tell[0]);
    ::close(watch);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << "it had not ended by itself";
    return times;
}

TEST(Kill, NeverLeavesAnUnreadableFileNorLosesMoreThanFiveSeconds) {
    const int rounds = testing::fuzzRounds(40);
    std::mt19937_64 random(4242);
    int recoveries = 0;
    int midway = 0;
    int strokes = 0;
    for (int round = 0; round < rounds; ++round) {
        const testing::TemporaryFolder folder;
        const fs::path path = folder.path() / "sky.lodestar.json";
        const document::Document start = Session::start();
        {
            Model model(start);
            DocumentFile file;
            ASSERT_TRUE(file.saveAs(model, path));
        }
        // Every other one anywhere, the rest while a file is being written.
        const auto among = [&](int least, int most) {
            return std::uniform_int_distribution<int>(least, most)(random);
        };
        const Moment moment = round % 2 == 0
                                  ? Moment{0, std::chrono::microseconds(among(2000, 120000))}
                                  : Moment{among(1, 8), std::chrono::microseconds(among(0, 1000))};
        const std::vector<double> times = killed(path, static_cast<std::uint64_t>(round), moment);
        const int last = static_cast<int>(times.size()) - 1;
        strokes += last;
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            midway += entry.path().string().find(".tmp-") != std::string::npos ? 1 : 0;
        }
        Model model;
        core::Tally warnings;
        const auto file = DocumentFile::open(path, model, warnings);
        ASSERT_TRUE(file) << file.error().message();
        int kept = strokeOf(model.document(), start);
        if (const auto recovered = file->recovery()) {
            const int side = strokeOf(*recovered, start);
            EXPECT_GT(side, kept) << "what is offered is newer";
            kept = std::max(kept, side);
            ++recoveries;
        }
        // The last stroke of all may be the one whose saving was cut off.
        ASSERT_LE(kept, last + 1);
        EXPECT_LE(last - kept, static_cast<int>(kAutosaveStrokes));
        if (kept + 1 < last) {
            const double lost = times[static_cast<std::size_t>(last - 1)] -
                                times[static_cast<std::size_t>(kept + 1)];
            EXPECT_LT(lost, kAutosaveSeconds) << "round " << round;
        }
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            EXPECT_EQ(entry.path().string().find(".tmp-"), std::string::npos) << "litter";
        }
    }
    // The killing must have been at work, or nothing was shown.
    EXPECT_GT(strokes, rounds);
    EXPECT_GT(recoveries, rounds / 10);
    EXPECT_GT(midway, 0) << "no round hit a file that was being written";
    RecordProperty("strokes", strokes);
    RecordProperty("recoveries", recoveries);
    RecordProperty("midway", midway);
    std::cout << rounds << " rounds, " << strokes << " strokes, " << recoveries << " recoveries, "
              << midway << " killed while writing\n";
}

} // namespace
} // namespace lodestar::model
