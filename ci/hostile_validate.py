"""Cases of ci/hostile: what a scene may do in mpipov-validate's own launches of POV-Ray."""

from hostile_acts import NOTES
from hostile_case import KEY, PICTURE, READ, SAY, Case

OUT = "out"  # of a command that keeps something
SMALL = ["scene.pov", "+W64", "+H48", "-A"]
# More than the probe's own renders have.
LARGE = ["scene.pov", "+W400", "+H300", "-A"]
NOISE = ["noise", "--renders", "3"]
SEAMS = ["seams", "--renders", "3", "--out", OUT, "--ranks", "1", "--sections", "2", "--seams", "plain",
         "--no-conditioning"]
SPEEDUP = ["speedup", "--repeat", "1", "--ranks", "2", "--schedule", "static", "--out", OUT]
TRADEOFF = ["tradeoff", "--repeat", "1", "--sweep", "antialiasing", "--out", OUT]
SSH = "{home}/.ssh/id"


def cases():
    # Refused not only by the probe, which goes through mpipov's own launches.
    late_key = "#if (image_width > 320)\n" + SAY.format(SSH) + "#end\n" + PICTURE
    library = {"shared/shared.inc": "#declare A = 1;\n"}
    found = {f"validate_{command[0]}_key": Case(late_key, LARGE, says=READ, validate=command)
             for command in (NOISE, SEAMS, SPEEDUP, TRADEOFF, ["stability"])}
    return {
        **found,
        "validate_key_in_the_probe": Case(SAY.format(SSH) + PICTURE, SMALL, says=READ, validate=NOISE),
        # Serial, by POV-Ray's threads, in bands from the shell, by mpipov.
        "validate_speedup_exists": Case(f'#if (file_exists("{SSH}")) #error "it can be opened" #end\n'
                                        + PICTURE, SMALL, code=0, validate=SPEEDUP),
        # stability renders copies that it makes of what the scene includes.
        "validate_stability_copy": Case(
            '#ifdef (Mpipov_Camera_Shift) #include "{home}/shared/view.inc" #end\n' + PICTURE, SMALL,
            says=READ, validate=["stability"],
            files={"shared/view.inc": f"// {KEY}\ncamera {{ location <0, 0, -4> look_at 0 }}\n"}),
        "validate_noise_library": Case('#include "shared.inc"\n' + PICTURE, [*SMALL, "+L../shared"], code=0,
                                       validate=NOISE, files=library),
        "validate_seams_library": Case('#include "shared.inc"\n' + PICTURE, [*SMALL, "+L../shared"], code=0,
                                       validate=SEAMS, files=library),
        "validate_seams_allowed": Case(SAY.format(SSH) + PICTURE, SMALL, code=0, validate=SEAMS,
                                       more=["--allow-read", "{home}/.ssh"], may_tell=True),
        "validate_noise_not_confined": Case(SAY.format(SSH) + PICTURE, SMALL, code=0, validate=NOISE,
                                            more=["--confine", "off"], may_tell=True),
        "validate_noise_notes": Case(NOTES, SMALL, code=0, says="--allow-write", validate=NOISE, files={
            "work/old.txt": "1,", "work/colour.inc": "#declare A = 1;\n"}),
        "validate_noise_allowed_to_write": Case(
            '#fopen F "../shared/written" write\n#fclose F\n' + PICTURE, SMALL, code=0, validate=NOISE,
            more=["--allow-write", "../shared"], made=["shared/written"], files={"shared/a.txt": ""}),
        "validate_noise_commands": Case(PICTURE, ["scene.ini", *SMALL[1:]], code=None, validate=NOISE, files={
            "work/scene.ini": "Input_File_Name=scene.pov\nPre_Scene_Command=touch {home}/ran\n"
                              "Pre_Frame_Command=touch {home}/ran\n"}),
        "validate_escapes": Case('#error concat(chr(27), "]0;title", chr(7))\n' + PICTURE, SMALL,
                                 says="^[^\x1b\x07]*title[^\x1b\x07]*$", validate=NOISE),
        "validate_escapes_in_a_render": Case(
            '#if (image_width > 320) #error concat(chr(27), "]0;title", chr(7)) #end\n' + PICTURE, LARGE,
            says="^[^\x1b\x07]*title[^\x1b\x07]*$", validate=NOISE),
        "validate_eat_memory": Case("#declare A = array[200000000];\n" + PICTURE, SMALL, says="--memory-limit",
                                    validate=NOISE, more=["--memory-limit", "300M"]),
    }
