#!/bin/sh
# Equal bands of rows, one POV-Ray for each and all of them at once: what can be had from a shell
# without mpipov, and what mpipov-validate speedup measures it against.
#
#     bands.sh BANDS WIDTH TOP BOTTOM IMAGE POVRAY SCENE [POV-Ray's options]
#
# WIDTH: of the whole image; TOP, BOTTOM: the rows to render, 0-based and half-open; IMAGE: the file
# to write, whose folder takes the bands too. Needs GNU xargs and oiiotool.
set -eu
bands=$1 width=$2 top=$3 bottom=$4 image=$5
shift 5
folder=$(dirname "$image")
extension=${image##*.}

start_of() {
    echo $((top + (bottom - top) * $1 / bands))
}

# POV-Ray takes +ER1 for 100 %: a band that ends at row 1 is rendered with a row more, over which
# the next band is pasted.
i=0
while [ "$i" -lt "$bands" ]; do
    last=$(start_of $((i + 1)))
    if [ "$last" -eq 1 ] && [ "$bands" -gt 1 ]; then last=2; fi
    printf '%s\n' "+SR$(($(start_of "$i") + 1))" "+ER$last" "+O\"$folder/band-$i.$extension\""
    i=$((i + 1))
done | xargs -d '\n' -n 3 -P "$bands" "$@"

# Every band is a full frame, black outside of the band. --paste wants what is pasted first, then
# what it is pasted on; alpha must stay as it lies in the file.
set -- oiiotool --no-autopremult "$folder/band-0.$extension"
i=1
while [ "$i" -lt "$bands" ]; do
    start=$(start_of "$i")
    set -- "$@" "$folder/band-$i.$extension" \
        --cut "${width}x$(($(start_of $((i + 1))) - start))+0+$start" --swap --paste "+0+$start"
    i=$((i + 1))
done
exec "$@" -o "$image"
