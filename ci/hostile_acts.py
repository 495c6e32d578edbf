"""Cases of ci/hostile: what a scene writes, runs, fills, eats and is called, or must not."""

import os

from hostile_case import HEAD, PICTURE, SMALL, Case, refused

# More than any picture needs, as fast as POV-Ray's language can.
FILL = """#fopen F "big.txt" write
#declare Line = "0123456789012345678901234567890123456789012345678901234567890123456789"
#while (1)
  #write (F, Line, Line, Line, Line, Line, Line, Line, Line, Line, Line, Line, Line, Line, "\\n")
#end
"""
MANY = """#declare I = 0;
#while (1)
  #fopen F concat("f", str(I, 0, 0), ".txt") write
  #fclose F
  #declare I = I + 1;
#end
"""
EAT = """#declare A = array[1000000];
#declare I = 0;
#while (I < 1000000)
  #declare A[I] = array[1000][100];
  #declare I = I + 1;
#end
"""
# Written, read again, and what an earlier run left behind extended.
NOTES = """#fopen F "notes.txt" write
#write (F, "0.5,")
#fclose F
#fopen F "old.txt" append
#write (F, "0.25,")
#fclose F
#fopen F "notes.txt" read
#read (F, Red)
#fclose F
#fopen F "old.txt" read
#read (F, Green, Blue)
#fclose F
#include "colour.inc"
sphere { 0, 1 pigment { rgb <Red, Green, Blue> } }
camera { location <0, 0, -4> look_at 0 }
light_source { <5, 8, -6> 1 }
"""
SIZE = SMALL[:3]


def shell(*commands):
    ini = "Input_File_Name=scene.pov\n" + "".join(
        f"{command}=touch {{home}}/work/ran\n" for command in commands)
    return Case(PICTURE, ["scene.ini"], code=None, files={"work/scene.ini": ini})


def named(name, *arguments, code=0, **more):
    """A scene of this name, given by these arguments or by its name."""
    return Case(PICTURE, list(arguments) or [name], code=code, files={f"work/{name}": HEAD + PICTURE},
                **more)


def cases():
    return {
        # Writing.
        "write_absolute": refused('#fopen F "{home}/written" write\n#fclose F\n',
                                  r"\A(?![\s\S]*--allow-write ')[\s\S]*may not be written"),
        "write_by_dots": Case('#fopen F "../written" write\n#fclose F\n' + PICTURE, code=0),
        "write_by_link": refused('#fopen F "there/written" write\n#fclose F\n', "--allow-write '",
                                 links={"work/there": "shared"}, files={"shared/a.txt": ""}),
        "write_over_scene": Case('#fopen F "scene.pov" write\n#write (F, "gone")\n#fclose F\n' + PICTURE,
                                 code=None),
        "notes": Case(NOTES, code=0, same_as_serial=True, files={
            "work/old.txt": "1,", "work/colour.inc": "#declare A = 1;\n"}),
        "allowed_to_write": Case('#fopen F "{home}/shared/written" write\n#fclose F\n' + PICTURE, code=0,
                                 more=["--allow-write", "../shared"], made=["shared/written"],
                                 files={"shared/a.txt": ""}),
        "allowed_to_write_by_dots": Case('#fopen F "../shared/written" write\n#fclose F\n' + PICTURE,
                                         code=0, more=["--allow-write", "../shared"],
                                         made=["shared/written"], files={"shared/a.txt": ""}),
        "writes_and_has_a_library": Case('#include "shared.inc"\n#fopen F "a.txt" write\n#fclose F\n'
                                         + PICTURE, ["scene.pov", "+L../shared"], code=0,
                                         files={"shared/shared.inc": "#declare A = 1;\n"}),
        "computed_name_over_a_file": Case(
            '#fopen F concat("a", ".txt") append\n#write (F, ",0.25")\n#fclose F\n'
            '#fopen F "a.txt" read\n#read (F, One, Two)\n#fclose F\n'
            '#if (One != 0.5 | Two != 0.25) #error "not what was written" #end\n' + PICTURE, code=0,
            files={"work/a.txt": "0.5"}),
        "write_by_linked_file": refused('#fopen F "there.txt" write\n#fclose F\n', "--allow-write '.*/shared'",
                                        links={"work/there.txt": "shared/a.txt"},
                                        files={"shared/a.txt": ""}),
        # Where mpipov itself writes.
        "output_of_the_scenes_ini": Case(PICTURE, ["scene.ini", *SIZE], code=2, says="--allow-write", files={
            "work/scene.ini": "Input_File_Name=scene.pov\nOutput_File_Name={home}/.ssh/image\n"}),
        "output_is_a_link": Case(PICTURE, code=2, says="shared/a.png",
                                 links={"work/image.png": "shared/a.png"}, files={"shared/a.png": ""}),
        "record_is_a_link": Case(PICTURE, code=2, says=".ssh/id", links={"work/run.json": ".ssh/id"}),
        # Running.
        "commands": shell("Pre_Scene_Command", "Pre_Frame_Command", "Post_Frame_Command",
                          "Post_Scene_Command", "User_Abort_Command", "Fatal_Error_Command"),
        # Filling, eating, looping.
        "fill_disk": Case(FILL, more=["--disk-limit", "4M"], says="--disk-limit"),
        "many_files": Case(MANY, more=["--disk-limit", "1M"], says="--disk-limit"),
        "huge_image": Case('sphere { 0, 1 pigment { image_map { ppm "a.ppm" } } }\n' + PICTURE,
                           more=["--memory-limit", "300M"], says="POV-Ray",
                           files={"work/a.ppm": "P6\n30000 30000\n255\n"}),
        "eat_memory": Case(EAT, more=["--memory-limit", "300M"], says="--memory-limit"),
        "recursion": Case("#macro M () M () #end\nM ()\n" + PICTURE, more=["--memory-limit", "300M",
                                                                          "--timeout", "20"]),
        "includes_itself": Case('#include "scene.pov"\n' + PICTURE, says="POV-Ray"),
        "loop": Case("#while (1) #end\n" + PICTURE, more=["--timeout", "3"], says="--timeout", seconds=60),
        "loop_in_sections": Case("#if (image_width > 100) #while (1) #end #end\n" + PICTURE,
                                 ["scene.pov", "+W128", "+H96"], more=["--timeout", "5", "--retries", "0"],
                                 says="--timeout", seconds=60),
        # Names and arguments.
        "dashes": named("--x.pov", "./--x.pov"),
        "dashes_after_dashes": named("--x.pov", *SMALL, "--", "./--x.pov"),
        "spaces": named("my own scene.pov"),
        # POV-Ray 3.7 itself opens no scene of such a name: as it does alone, with its own words.
        "umlaut": named("schön.pov", code=3, says="Cannot find file"),
        "not_utf8": named(os.fsdecode(b"sch\xf6n.pov"), code=3, says="Cannot find file"),
        "newline": named("two\nlines.pov", code=2, says="line"),
        "control": named("bell\a.pov", code=2, says="control"),
        "newline_in_option": named("scene.pov", "scene.pov", "Output_File_Name=a\nb.png", code=2,
                                   says="line"),
        "escapes": Case('#warning concat(chr(27), "]0;title", chr(7))\n' + PICTURE, code=0,
                        says="^[^\x1b\x07]*title[^\x1b\x07]*$"),
        "nothing": named("scene.pov", "scene.pov", "", code=2, says="empty"),
    }
