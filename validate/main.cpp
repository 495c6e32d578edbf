// mpipov-validate: parses, runs the subcommand, prints the one error.
#include "compare_command.h"
#include "failure.h"
#include "interrupt.h"
#include "json_input.h"
#include "noise_command.h"
#include "printable.h"
#include "report_command.h"
#include "seams_command.h"
#include "simulate_command.h"
#include "speedup_command.h"
#include "stability_command.h"
#include "standard_output.h"
#include "tradeoff_command.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

using mpipov::Exit;

int finish(Exit code) {
    return static_cast<int>(code);
}

int run(int argc, char** argv) {
    CLI::App program(
        "Measures how an image that was rendered in sections differs from a serial "
        "render.",
        "mpipov-validate");
    program.set_version_flag("--version", MPIPOV_VERSION);
    program.require_subcommand(1);
    const std::vector<mpipov::Command> commands{
        mpipov::add_compare_command(program),   mpipov::add_noise_command(program),
        mpipov::add_seams_command(program),     mpipov::add_speedup_command(program),
        mpipov::add_simulate_command(program),  mpipov::add_tradeoff_command(program),
        mpipov::add_stability_command(program), mpipov::add_report_command(program)};
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
        return program.exit(asked);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "mpipov-validate: {} (try --help)\n", error.what());
        return finish(Exit::usage);
    }
    for (const mpipov::Command& command : commands)
        if (command.app->parsed()) return finish(command.run());
    return finish(Exit::usage);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        mpipov::block_interrupts();
        const int code = run(argc, argv);
        mpipov::print_result("");  // what was printed until here must have arrived
        return code;
    } catch (const mpipov::Failure& failure) {
        fmt::print(stderr, "mpipov-validate: {}\n",
                   mpipov::printable(mpipov::plain_words(failure.what())));
        return finish(failure.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "mpipov-validate: {}\n",
                   mpipov::printable(mpipov::plain_words(error.what())));
        return finish(Exit::file);
    }
}
