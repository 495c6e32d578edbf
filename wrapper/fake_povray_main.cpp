// fake_povray: a stand-in for POV-Ray in tests of the protocol, and only there. It takes the
// arguments that mpipov gives to POV-Ray, renders nothing, and writes a full-frame PPM file with
// the known picture (known_picture.h) in its section and zeros outside. With +RFO it writes no
// image but two radiosity samples behind what the cache holds: one that every section takes, and
// one of its section that says how many there were.
//
// FAKE_POVRAY names a fault, or several ("slow no-file"):
//   error      ends with 1 after an error message in POV-Ray's words
//   crash      ends by SIGSEGV
//   hang       sleeps for ever
//   no-file    ends with 0 and writes nothing
//   truncated  writes the first half of the file
//   wrong-size writes a frame of one more row
//   slow       first prints progress, 20 times within a second
//   linger     has done its work, and sleeps for ever
//   few-samples, half-a-sample
//              saves fewer radiosity samples than it says that it took; a last one cut short
//   late-error closes a file that is cut short, then says that the disk is full, ends with 1
//   copy       writes a copy of the file that FAKE_POVRAY_COPY names
// FAKE_POVRAY_ONCE names a file: where it can be made, the fault happens, else it does not.
// FAKE_POVRAY_COLUMN: the fault happens only where the section's +SC is this one.

#include "known_picture.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

namespace {

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

struct Job {
    int width = 0, height = 0;
    std::string first_column;
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // half-open
    std::string base;
    std::string cache;  // +RF
    bool gathers = false, reads = false;
};

Job parse(int argc, char** argv) {
    Job job;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const std::string key = argument.substr(0, 3),
                          value = argument.substr(std::min<std::size_t>(3, argument.size()));
        // 0 and 1 both are the first column or row.
        if (key == "+SC") {
            job.first_column = value;
            job.x0 = std::max(1, std::stoi(value)) - 1;
        } else if (key == "+SR") {
            job.y0 = std::max(1, std::stoi(value)) - 1;
        } else if (key == "+EC") {
            job.x1 = std::stoi(value);
        } else if (key == "+ER") {
            job.y1 = std::stoi(value);
        } else if (argument.starts_with("+WT")) {
            continue;
        } else if (argument.starts_with("+W")) {
            job.width = std::stoi(argument.substr(2));
        } else if (argument.starts_with("+H")) {
            job.height = std::stoi(argument.substr(2));
        } else if (argument == "+RFO") {
            job.gathers = true;
        } else if (argument == "+RFI") {
            job.reads = true;
        } else if (argument.starts_with("+RF\"")) {
            job.cache = argument.substr(4, argument.size() - 5);
        } else if (argument.starts_with("+O\"")) {
            job.base = argument.substr(3, argument.size() - 4);
        }
    }
    return job;
}

// As a sparse file: what lies outside the section takes neither time nor disk, so that thousands of
// sections of a large image can be "rendered".
void write_frame(const std::string& file, const Job& job, int rows) {
    const std::string header =
        "P6\n" + std::to_string(job.width) + ' ' + std::to_string(rows) + "\n255\n";
    const auto row_bytes = static_cast<std::streamoff>(job.width) * mpipov::known_channels;
    std::ofstream out(file, std::ios::binary);
    out << header;
    std::string text;
    for (int y = job.y0; y < std::min(job.y1, rows); ++y) {
        text.clear();
        for (int x = job.x0; x < job.x1; ++x)
            for (const unsigned char value : mpipov::known_pixel(x, y))
                text += static_cast<char>(value);
        out.seekp(static_cast<std::streamoff>(header.size()) + y * row_bytes +
                  std::streamoff{job.x0} * mpipov::known_channels);
        out << text;
    }
    out.close();
    if (!out) throw std::runtime_error("cannot write " + file);
    std::filesystem::resize_file(
        file, header.size() + static_cast<std::uintmax_t>(row_bytes) * static_cast<unsigned>(rows));
}

void gather(const Job& job) {
    int known = 0;
    if (job.reads) {
        std::ifstream in(job.cache);
        for (std::string line; std::getline(in, line);) ++known;
    }
    std::ofstream out(job.cache, std::ios::app);
    out << "C1\t0\t0\t0\t0\t0\t0\t0\t0\t0\t0\n"
        << "C2\t" << job.x0 << '\t' << job.y0 << '\t' << job.x1 << '\t' << job.y1 << '\t' << known
        << "\t0\t0\t0\t0\t0\n";
}

bool fault_is_due(const Job& job) {
    const std::string column = environment("FAKE_POVRAY_COLUMN");
    if (!column.empty() && column != job.first_column) return false;
    const std::string once = environment("FAKE_POVRAY_ONCE");
    if (once.empty()) return true;
    const int file = ::open(once.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
    if (file >= 0) ::close(file);
    return file >= 0;
}

void print_progress() {
    for (int percent = 0; percent <= 95; percent += 5) {
        std::cerr << "Rendered " << percent << " of 100 pixels (" << percent << "%)\r"
                  << std::flush;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    std::cerr << '\n';
}

constexpr const char* statistics =
    "Render Time:\n  Photon Time:      No photons\n  Radiosity Time:   No radiosity\n"
    "  Trace Time:       0 hours  0 minutes  0 seconds (0.001 seconds)\n"
    "              using 1 thread(s) with 0.001 CPU-seconds total\n";

int run(const Job& job) {
    const std::string faults = fault_is_due(job) ? environment("FAKE_POVRAY") : "";
    const auto has = [&](std::string_view fault) {
        return (' ' + faults + ' ').find(' ' + std::string(fault) + ' ') != std::string::npos;
    };
    std::cerr << "File 'scene.pov' line 3: Parse Warning: a warning of the stand-in\n";
    if (has("slow")) print_progress();
    if (has("hang"))
        for (;;) ::pause();
    if (has("crash")) {
        std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would make an exit code of it
        std::raise(SIGSEGV);
    }
    if (has("error")) {
        std::cerr << "File 'scene.pov' line 7: Parse Error: Undeclared identifier 'Sphere'\n"
                     "Fatal error in parser: Cannot parse input.\nRender failed\n";
        return 1;
    }
    if (job.gathers) {
        if (!has("no-file")) gather(job);
        if (has("half-a-sample")) std::ofstream(job.cache, std::ios::app) << "C1\t0";
        if (has("few-samples")) std::cerr << "Radiosity samples calculated:   100 (2.32 %)\n";
        std::cerr << statistics << std::flush;
        if (has("linger"))
            for (;;) ::pause();
        std::cerr << "POV-Ray finished\n";
        return 0;
    }
    std::ofstream(job.base + ".pov-state") << "state";
    if (has("no-file")) return 0;
    if (has("copy")) {
        const std::filesystem::path from = environment("FAKE_POVRAY_COPY");
        std::filesystem::copy_file(from, job.base + from.extension().string());
        return 0;
    }
    const std::string file = job.base + ".ppm";
    write_frame(file, job, job.height + (has("wrong-size") ? 1 : 0));
    if (has("truncated") || has("late-error"))
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    std::cerr << statistics << std::flush;
    if (has("linger"))
        for (;;) ::pause();
    if (has("late-error")) {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        std::cerr << "Fatal error in renderer: Cannot write file: No space left\nRender failed\n";
        return 1;
    }
    std::cerr << "POV-Ray finished\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(parse(argc, argv));
    } catch (const std::exception& error) {
        std::cerr << "fake_povray: " << error.what() << '\n';
        return 2;
    }
}
