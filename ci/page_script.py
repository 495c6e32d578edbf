"""The command line of the scripts that measure something and write a page of docs/ about it."""

from pathlib import Path

from program_runs import ROOT, argument_parser


def page_script(description, name, measure, page, measure_arguments=None):
    """Runs `NAME.py measure` or `NAME.py page` and returns its exit code.

    measure, page: functions of the options, of which `work` is this script's own folder and `page`
    the file to write. measure_arguments(parser) adds what `measure` takes besides.
    """
    parser = argument_parser(description)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    measuring = commands.add_parser("measure")
    if measure_arguments:
        measure_arguments(measuring)
    measuring.set_defaults(command=measure)
    written = commands.add_parser("page")
    written.add_argument("--page", type=Path, default=ROOT / "docs" / f"{name}.md", metavar="FILE")
    written.set_defaults(command=page)
    options = parser.parse_args()
    options.work = options.work.resolve() / name
    return options.command(options)
