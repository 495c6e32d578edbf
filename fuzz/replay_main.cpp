// Runs a fuzzer's entry point without libFuzzer: all of its corpus, a megabyte of each word of its
// dictionary, then inputs that are made of these for some seconds. Prints JSON.
//
//     NAME_replay --corpus DIR [--dictionary FILE] [--seconds S] [--seed N] [--keep DIR]
//     NAME_replay FILE...       only these
//
// An input that crashes, or takes more than ten seconds, is kept as DIR/crash. Exit codes: 0 ok, 2
// usage; else the signal's.
#include "entry.h"
#include "mutate.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using mpipov::fuzz::Mutator;
using Clock = std::chrono::steady_clock;

constexpr unsigned most_seconds = 10;
constexpr std::size_t stretched_bytes = std::size_t{1} << 20;

// For the signal handler, which can be handed nothing else.
struct Current {
    const char* data = nullptr;
    std::size_t size = 0;
    char file[4096] = {};
};
Current current;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

extern "C" void keep_input(int signal) {
    const int fd = ::open(current.file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const auto written = ::write(fd, current.data, current.size);
    constexpr char said[] = "the input is kept: see --keep\n";
    const bool ok = written == static_cast<ssize_t>(current.size) &&
                    ::write(STDERR_FILENO, said, sizeof said - 1) > 0;
    std::signal(signal, SIG_DFL);
    std::raise(ok ? signal : SIGKILL);
}

// On a stack of its own: the other one may have overflowed.
void catch_crashes(const fs::path& keep) {
    const std::string file = (keep / "crash").string();
    std::strncpy(current.file, file.c_str(), sizeof current.file - 1);
    static char stack[1 << 16];
    stack_t other{};
    other.ss_sp = stack;
    other.ss_size = sizeof stack;
    ::sigaltstack(&other, nullptr);
    struct sigaction action {};
    action.sa_handler = &keep_input;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM})
        ::sigaction(signal, &action, nullptr);
}

void run(const std::string& input) {
    current.data = input.data();
    current.size = input.size();
    ::alarm(most_seconds);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    ::alarm(0);
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> corpus_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> corpus;
    for (const fs::path& file : files) corpus.push_back(bytes_of(file));
    return corpus;
}

// libFuzzer's form: a word a line in quotation marks, \\, \" and \xHH; # begins a comment.
std::vector<std::string> words_in(const fs::path& file) {
    std::vector<std::string> words;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.size() < 2 || line.front() != '"' || line.back() != '"') continue;
        std::string word;
        for (std::size_t i = 1; i + 1 < line.size(); ++i) {
            if (line[i] == '\\' && line[i + 1] == 'x' && i + 3 < line.size()) {
                word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
                i += 3;
            } else {
                if (line[i] == '\\') ++i;
                word += line[i];
            }
        }
        words.push_back(word);
    }
    return words;
}

struct Request {
    fs::path corpus, dictionary, keep = ".";
    double seconds = 0;
    unsigned seed = 1;
    std::vector<fs::path> files;
};

Request parse(const std::vector<std::string>& arguments) {
    Request request;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& name = arguments[i];
        if (!name.starts_with("--")) {
            request.files.emplace_back(name);
            continue;
        }
        const std::string& value = arguments.at(++i);
        if (name == "--corpus")
            request.corpus = value;
        else if (name == "--dictionary")
            request.dictionary = value;
        else if (name == "--keep")
            request.keep = value;
        else if (name == "--seconds")
            request.seconds = std::stod(value);
        else if (name == "--seed")
            request.seed = static_cast<unsigned>(std::stoul(value));
        else
            throw std::out_of_range(name);
    }
    if (request.files.empty() && request.corpus.empty()) throw std::out_of_range("--corpus");
    return request;
}

int fuzz(const Request& request) {
    for (const fs::path& file : request.files) run(bytes_of(file));
    if (request.corpus.empty()) return 0;
    const auto begin = Clock::now();
    const auto elapsed = [begin] {
        return std::chrono::duration<double>(Clock::now() - begin).count();
    };
    std::vector<std::string> corpus = corpus_in(request.corpus);
    const std::vector<std::string> words = words_in(request.dictionary);
    if (corpus.empty()) throw std::out_of_range("the corpus is empty");
    long long executions = 0;
    for (const std::string& input : corpus) {
        run(input);
        run({});
        executions += 2;
    }
    for (const std::string& word : words) {
        run(mpipov::fuzz::stretched(word, stretched_bytes));
        ++executions;
    }
    Mutator mutator(words, request.seed);
    while (elapsed() < request.seconds) {
        run(mutator.next(corpus));
        ++executions;
    }
    fmt::print(R"({{"corpus": {}, "words": {}, "seed": {}, "seconds": {:.1f}, "executions": {}}})"
               "\n",
               corpus.size(), words.size(), request.seed, elapsed(), executions);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Request request;
    try {
        request = parse({argv + 1, argv + argc});
    } catch (const std::exception&) {
        fmt::print(stderr,
                   "usage: --corpus DIR [--dictionary FILE] [--seconds S] [--seed N] "
                   "[--keep DIR] | FILE...\n");
        return 2;
    }
    catch_crashes(request.keep);
    // What a file claims to hold must not be believed. (Sanitizers need all addresses there are.)
#if !defined(__SANITIZE_ADDRESS__)
    const rlimit memory{rlim_t{2} << 30, rlim_t{2} << 30};
    ::setrlimit(RLIMIT_AS, &memory);
#endif
    return fuzz(request);
}
