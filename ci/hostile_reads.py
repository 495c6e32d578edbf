"""Cases of ci/hostile: what a scene reads, or must not."""

from hostile_case import (HEAD, KEY, PICTURE, PROPOSED, READ, SAY, Case, refused,
                          refused_read)

# As POV-Ray says it of a file that it does not find.
NOT_FOUND = ("Possible Parse Error: Cannot find file '{home}/shared/a.inc', even after trying to append "
             "file type extension.")
# In place of POV-Ray.
SCRIPT = '#!/bin/sh\nexec povray "$@"\n'


def cases():
    ssh = "{home}/.ssh/id"
    return {
        # Reading.
        "key": refused_read(ssh),
        "key_by_dots": refused_read("../.ssh/id"),
        "key_by_include": refused(f'#include "{ssh}"\n', READ),
        "key_by_image": refused(f'sphere {{ x, 1 pigment {{ image_map {{ png "{ssh}" }} }} }}\n',
                                READ),
        "key_by_font": refused(f'text {{ ttf "{ssh}" "a", 1, 0 }}\n', READ),
        "key_by_link": refused_read("innocent.txt", links={"work/innocent.txt": ".ssh/id"}),
        # mpipov makes copies of what a scene writes to: not of what it may not read.
        "key_by_copied_link": refused('#if (0) #fopen F "innocent.txt" append #end\n'
                                      + SAY.format("innocent.txt"), READ,
                                      links={"work/innocent.txt": ".ssh/id"}),
        "key_by_linked_folder": refused_read("inside/id", links={"work/inside": ".ssh"}),
        "key_by_ini": Case(SAY.format("id") + PICTURE, ["scene.ini"], says="Cannot (find|open)", files={
            "work/scene.ini": "Input_File_Name=scene.pov\nLibrary_Path={home}/.ssh\n"}),
        "key_as_scene": Case(PICTURE, ["scene.ini"], says="POV-Ray", files={
            "work/scene.ini": "Input_File_Name={home}/.ssh/id\n"}),
        "neighbour_in_home": Case("", ["scene.pov"], says=READ, folder=".", files={
            "scene.pov": HEAD + SAY.format("passwords.txt") + PICTURE, "passwords.txt": f'"{KEY}"\n'}),
        "run_in_home": Case(SAY.format("passwords.txt") + PICTURE, ["work/scene.pov"], says=READ,
                            folder=".", files={"passwords.txt": f'"{KEY}"\n'}),
        "environment": refused_read("/proc/self/environ"),
        "system": refused_read("/etc/passwd"),
        "exists": Case(f'#if (file_exists("{ssh}")) #error "it can be opened" #end\n' + PICTURE, code=0),
        "allowed": Case(SAY.format(ssh) + PICTURE, more=["--allow-read", "{home}/.ssh"], code=0,
                        says=KEY, may_tell=True),
        "not_confined": Case(SAY.format(ssh) + PICTURE, more=["--confine", "off"], code=0, says=KEY,
                             may_tell=True),
        "named_library": Case('#include "shared.inc"\n' + PICTURE, ["scene.pov", "+L{home}/shared"],
                              code=0, files={"shared/shared.inc": "#declare A = 1;\n"}),
        "scene_in_home": Case("", ["scene.pov"], code=0, folder=".", files={
            "scene.pov": HEAD + '#include "ball.inc"\n' + PICTURE, "ball.inc": "#declare A = 1;\n"}),
        "library_of_the_scenes_ini": Case('#include "shared.inc"\n' + PICTURE, ["scene.ini"], says=PROPOSED,
                                          files={"work/scene.ini": "Input_File_Name=scene.pov\n"
                                                 "Library_Path=../shared\n",
                                                 "shared/shared.inc": "#declare A = 1;\n"}),
        "kernels_file": Case('#declare S = "/proc/kmsg";\n' + PICTURE, code=0, seconds=60),
        "folders_of_the_scene": Case(
            '#include "parts/ball.inc"\nplane { y, -1 pigment { image_map { ppm "parts/tile.ppm" } } }\n' + PICTURE, ["work/scene.pov", "+Lwork"],
            code=0, folder=".", files={"work/parts/ball.inc": "#declare A = 1;\n",
                                       "work/parts/tile.ppm": "P3\n1 1\n255\n255 0 0\n"}),
        "own_settings": Case(PICTURE, code=0, same_as_serial=True,
                             files={".povray/3.7/povray.ini":
                                    "Library_Path=/usr/share/povray-3.7/include\nStart_Row=9\n"}),
        # POV-Ray's own files.
        "empty_part_of_the_library_path": Case(
            PICTURE, code=0, environment={"LD_LIBRARY_PATH": ":/nowhere"},
            files={"work/libSDL-1.2.so.0": "no library"}),
        "script_in_home": refused_read("{home}/passwords.txt", more=["--povray", "{home}/render"],
                                       files={"passwords.txt": f'"{KEY}"\n'},
                                       programs={"render": SCRIPT}),
        "program_in_home": refused_read("{home}/lib/id", more=["--povray", "{home}/bin/povray"],
                                        files={"lib/id": f'"{KEY}"\n'}, programs={"bin/povray": ""}),
        "installed_in_home": Case(
            '#include "{home}/opt/povray/share/povray-3.7/include/own.inc"\n' + PICTURE, code=0,
            more=["--povray", "{home}/opt/povray/bin/povray"], programs={"opt/povray/bin/povray": ""},
            files={"opt/povray/share/povray-3.7/include/own.inc": "#declare A = 1;\n"}),
        # What the user named, and no more for that.
        "beside_a_cache": refused_read("{home}/cache/id", files={"cache/id": f'"{KEY}"\n', "cache/a": ""},
                                       arguments=["scene.pov", "+RF{home}/cache/a"]),
        "beside_a_linked_scene": Case("", ["linked.pov"], says=READ,
                                      links={"work/linked.pov": "shared/real.pov"},
                                      files={"shared/real.pov": HEAD + SAY.format("../shared/id") + PICTURE,
                                             "shared/id": f'"{KEY}"\n'}),
        "copied_of_home": Case("", ["scene.pov"], says=READ, folder=".", files={
            "scene.pov": HEAD + '#if (0) #fopen F "passwords.txt" append #end\n'
            + SAY.format("passwords.txt") + PICTURE, "passwords.txt": f'"{KEY}"\n'}),
        # What is proposed.
        "error_looks_like_povrays": refused(f'#error "{NOT_FOUND}"\n', r"\A(?![\s\S]*--allow-read)",
                                            files={"shared/a.inc": ""}),
        "debug_looks_like_povrays": refused(f"#debug \"File 'a.pov' line 1: {NOT_FOUND}\\n\"\n#error \"x\"\n",
                                            r"\A(?![\s\S]*--allow-read)", files={"shared/a.inc": ""}),
        # Other ways to the same.
        "key_by_proc_root": refused_read("/proc/self/root{home}/.ssh/id"),
        "endless_include": Case('#include "/dev/zero"\n' + PICTURE, code=None,
                                more=["--memory-limit", "300M", "--timeout", "10"]),
        "pipe": refused('#fopen F "pipe" read\n', "--timeout", pipes=["work/pipe"],
                        more=["--timeout", "1"]),
    }
