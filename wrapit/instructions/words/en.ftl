# Every text of the guide, in English. The same keys are in de.ftl.
# Lengths, thicknesses, weights and lists arrive as words; numbers as numbers.

## The page itself
language = en
page-title = { $name }: how to make it
contents = Contents
steps-title = Step by step
all-steps = All steps
one-step = One step at a time
back = Back
next = Next
step-of = { $step } of { $steps }
progress = How far you are
get-ready = Get ready
strips-title = Ruler strips
true-size-title = The piece at true size
caution = Mind

## Quantities and lists
and = and
or = or
length = { $value }
thickness = { $value }
mass = { $value }
number = { $value }
plain = { $value }
size-flat = { $x } × { $y }
size-solid = { $x } × { $y } × { $z }
duration = { $hours ->
    [0] { $minutes } min
   *[other] { $minutes ->
        [0] { $hours } h
       *[other] { $hours } h { $minutes } min
    }
}
wire-number = wire { $wire }
wire-capital = Wire { $wire }
wire-at = wire { $wire } at { $at }
itself = itself

## First page
lead = { $pieces ->
    [one] { $wires ->
        [one] One wire
       *[other] { $wires } wires
    }
   *[other] A pair, each of { $wires ->
        [one] one wire
       *[other] { $wires } wires
    }
}, { $ties ->
    [0] no ties
    [one] one tie
   *[other] { $ties } ties
}; finished size { $x } × { $y }.
cover-picture = The finished piece with its wires in different colours, numbered where they start
cover-caption = The finished piece. Each colour is one wire; its number stands where it starts.{ $ring ->
    [yes] {" "}The open circle shows where the jump ring goes.
   *[no] {""}
}

## Materials
materials-title = What you need
materials-table = Metal
materials-head-what = Material
materials-head-thickness = Thickness
materials-head-length = In all
materials-head-weight = Weight
material-frame = { $metal } wire, { $temper }, for the frame
material-binding = { $metal } wire, dead soft, for binding
material-ring = { $count ->
    [one] { $metal } jump ring
   *[other] { $count } { $metal } jump rings
}, { $inside } inside; or bend it round a rod of that thickness
metal-copper = copper
metal-brass = brass
metal-bronze = bronze
metal-sterling-silver = sterling silver
metal-fine-silver = fine silver
metal-gold-filled = gold-filled
metal-aluminium = aluminium
metal-steel = steel
temper-dead-soft = dead soft
temper-half-hard = half hard
temper-hard = hard
beads-table = Beads
beads-head-size = Size
beads-head-count = How many
cut-table = Cut list
cut-head-wire = Wire
cut-head-cut = Cut
cut-head-tail = Each tail
cut-head-shape = Shape
cut-pieces = { $count ->
    [one] { $length }
   *[other] { $count } × { $length }
}
tools = Wire cutter, flat-nose pliers, round-nose pliers, a ruler, a fine marker, sticky tape.
tools-jig = { $board ->
    [yes] The board with its pegs.
   *[no] { $count ->
        [one] The jig.
       *[other] { $count } jigs.
    }
}
tools-jigs = They are named { $names }.
fact-difficulty = Difficulty
difficulty-easy = easy: a first piece
difficulty-medium = medium: take your time
difficulty-hard = hard: for practised hands
fact-time = Time
time-about = about { $time } with the jig ready

## Printing the jig
other-jig = One jig is enough: this one, or that of “{ $title }”, which the steps show.
print-title = { $jigs ->
    [one] Print the jig
   *[other] Print the jigs
}
print-how = { $jigs ->
    [one] It lies
   *[other] Each lies
} in the file as it is printed: plate down, walls up, no supports. Keep the scale at 100 %; don’t let the slicer fit it to the bed.
print-clean = When it has cooled, push a piece of the wire through each hole, and scrape off what hangs at the walls’ feet: the wire has to lie flat on the plate.
jig-for = { $jig }: for { $count ->
    [one] wire { $wires }
   *[other] wires { $wires }
}
jig-picture = { $jig } from above: walls, holes and the wires, numbered where they start
jig-caption = The jig from above. Brown are its walls, the coloured lines the wires; each number stands at the hole where that wire starts.
fact-file = File
file-one-of = { $files }
file-none = none was asked for: add 3mf to outputs
file-none-flat = none was asked for: add dxf to outputs
fact-other-earring = Other earring
file-mirrored = { $count ->
    [0] none was asked for: add 3mf to outputs
   *[other] { $files }: its mirror image
}
fact-material = Material
print-material = PLA or PETG
fact-settings = Settings
print-settings = layers of 0.2 mm, two perimeters, 20 % infill, no supports
fact-size = Size
fact-takes = It takes about
takes-about = { $time }, { $mass }
pins-how = { $pins ->
    [one] One bend is too tight for a wall. Push a nail or a piece of rod into the small hole inside it and bend the wire around it:
   *[other] Some bends are too tight for a wall. Push a nail or a piece of rod into the small hole inside each of them and bend the wire around it:
}
pin-line = wire { $wire }, { $at } from its start mark: { $rod } thick

## Gluing the laser-cut jig
glue-title = Cut and glue the jig
glue-how = The jig is cut from sheet and glued like an inlay: a bottom plate, on it a plate with pockets, and wall pieces that fit into the pockets. You need wood glue (or acrylic cement), cocktail sticks as pins, and clamps.
glue-sheets = Sheets to cut
glue-head-sheet = Sheet
glue-head-thickness = Thickness
glue-head-size = Size
glue-head-parts = Parts
glue-head-file = File
glue-leave = Leave the parts in the sheet until you need them, or mark them as you take them out: the smallest have their number beside them in the sheet.
glue-pair = The sheets are for one of the pair. For the other, mirror the drawing in the laser’s program.
glue-picture = Map of { $jig }: the plate with its wall pieces, numbered
glue-caption = Where each piece goes. The coloured lines are the wires, which are engraved on the plate too.
glue-bottom = Lay the bottom plate { $part } on the table, engraving up. It shows the number of each wall piece where its pocket will be.
glue-plate = Spread a thin film of glue around the numbers. Lay plate { $part } on it, engraving up, and push a pin through each of the three corner holes: it fits one way only. Wipe glue out of the pockets, press flat, and pull the pins out.
glue-wall = Glue { $count ->
    [one] wall piece { $parts }, number up, into its pocket
   *[other] wall pieces { $parts }, numbers up, into their pockets
}{ $where ->
    [in] {" "}inside piece { $inside }
   *[plate] {""}
}.{ $copies ->
    [one] {""}
    [2] {" "}Glue the second copy of each flush on top.
   *[other] {" "}Glue the other { $more } copies of each flush on top.
}
glue-island = Glue { $count ->
    [one] the small plate { $parts }
   *[other] the small plates { $parts }
}, engraving up, into the hole { $where ->
    [in] inside piece { $inside }
   *[plate] of the plate
}.
glue-dry = Weigh it down until the glue is dry. The walls now stand { $height } above the plate.

## The board with pegs
pegs-title = Set up the board with pegs
pegs-how = The board has { $columns } columns and { $rows } rows of holes, { $pitch } apart; columns have letters from the left, rows numbers from below.
pegs-file = The drawing ({ $files }) shows it at true size: lay it under a clear board, or hold it against yours.
pegs-pair = This is the board for one of the pair. For the other, mirror it: columns then have their letters from the right.
pegs-picture = The board with its pegs and the wires bent round them
pegs-caption = The pegs stand inside the bends; the coloured lines are the wires.
pegs-table = Pegs
pegs-head-hole = Hole
pegs-head-peg = Peg
pegs-head-round = Bend round it
pegs-unserved = { $turns ->
    [one] No peg stands right for one bend; make it by hand over the drawing:
   *[other] No peg stands right for these bends; make them by hand over the drawing:
}

## How to read the steps
read-steps = Left and right are meant as you follow the wire away from its start, looking from above. In the pictures, the line with the dark edge is what you do now, with an arrow at its end; what lies already is coloured, what comes later is pale; the walls to use are dark.
chapter-wire = { $which ->
    [other] The other earring: wire { $wire } of { $wires }
   *[first] Wire { $wire } of { $wires }
}
chapter-together = { $which ->
    [other] The other earring: put it together
   *[first] Put it together
}

## Starting a wire
heading-start = Start wire { $wire }
take-jig = Take { $jig }.
set-beads = { $count ->
    [one] Set the bead or stone ({ $sizes } thick) into its seat.
   *[other] Set the beads or stones ({ $sizes } thick) into their seats.
}
start-cut = Cut { $cut } of wire, and mark it { $tail } from one end: that is the tail, and the mark is where the shape starts.
start-hole = Push the tail down through hole { $hole } as far as the mark, and bend it flat below the plate: it holds the wire, and the jig lies flat.
start-board = Hold the mark over the start on the drawing, with tape over the tail.
start-hand = Lay the mark on the start in the drawing at true size, with tape over the tail.
start-unmarked = There was no room to engrave { $hole } beside its hole: the picture shows it.
start-way = Lead the wire { $way }, as in the picture.
way-right = to the right
way-upper-right = up and to the right
way-up = up
way-upper-left = up and to the left
way-left = to the left
way-lower-left = down and to the left
way-down = down
way-lower-right = down and to the right
spring-made-up = The jig bends the wire a little further than the piece shows, by what the metal springs back: press it close to the walls, then lift it out and let it go.
spring-further = The metal springs back a little: bend a right angle with a radius of { $radius } about { $angle }° further than you need.

## Along a wire
heading-wrap = Wrap to the { $side ->
    [left] left
   *[right] right
}
heading-bend = Bend to the { $side ->
    [left] left
   *[right] right
}
heading-curve = Curve to the { $side ->
    [left] left
   *[right] right
}
heading-fold = Fold back
heading-hairpin = Turn back
heading-loop = A loop
heading-spiral = A spiral
heading-bail = The loop to hang it from
heading-repeat = The same { $times } times
lead-on = Go straight on for { $length }.
lead-to-wall = Go straight on for { $length }, to the wall on the { $side ->
    [left] left
   *[right] right
}.
lead-to-pin = Go straight on for { $length }, to the pin on the { $side ->
    [left] left
   *[right] right
}.
lead-to-run = Go straight on for { $length }, close beside the run on the { $side ->
    [left] left
   *[right] right
}.
lead-to-peg = Go straight on for { $length }, to the peg in { $hole }.
do-wrap-wall = Wrap the wire round the { $walls ->
    [one] wall
   *[other] walls
} on its { $side ->
    [left] left
   *[right] right
}, tight, by about { $angle }°: { $length } of wire, radius { $radius }.
do-wrap-pin = Wrap the wire to the { $side ->
    [left] left
   *[right] right
} round the pin ({ $rod }), by about { $angle }°.
do-wrap-run = Bend it to the { $side ->
    [left] left
   *[right] right
} round the run that lies there, close beside it, by about { $angle }°: { $length } of wire.
do-wrap-peg = Wrap the wire to the { $side ->
    [left] left
   *[right] right
} round the peg in { $hole } ({ $rod }), by about { $angle }°.
do-bend = Bend it to the { $side ->
    [left] left
   *[right] right
} by about { $angle }°, with round-nose pliers.
do-curve = Let it run in a curve to the { $side ->
    [left] left
   *[right] right
}: about { $angle }° over { $length }.
do-by-hand-curve = With your fingers, bend a curve to the { $side ->
    [left] left
   *[right] right
}: about { $angle }° over { $length }, radius { $radius }.
do-fold = Fold it back to the { $side ->
    [left] left
   *[right] right
}, about { $angle }°, with flat-nose pliers.
do-hairpin = With round-nose pliers, bend a narrow loop to the { $side ->
    [left] left
   *[right] right
}, about { $angle }°, radius { $radius }, so that the wire comes back close beside itself.
do-hairpin-wall = Bend a narrow loop to the { $side ->
    [left] left
   *[right] right
} round the wall in it, tight, about { $angle }°, so that the wire comes back close beside itself.
do-hairpin-pin = Bend a narrow loop to the { $side ->
    [left] left
   *[right] right
} round the pin in it ({ $rod }), about { $angle }°, so that the wire comes back close beside itself.
do-hairpin-peg = Bend a narrow loop to the { $side ->
    [left] left
   *[right] right
} round the peg in { $hole } ({ $rod }), about { $angle }°, so that the wire comes back close beside itself.
do-loop = Make a loop to the { $side ->
    [left] left
   *[right] right
}, about { $angle }°: { $length } of wire, radius { $radius }.
do-spiral = Wind a spiral to the { $side ->
    [left] left
   *[right] right
}: about { $turns } turns, { $length } of wire.
do-bail = Bend the neck and the loop to hang the piece from, round a rod of { $rod } or the post in the jig ({ $length } of wire). When the piece is together, wrap the tail twice round the neck.
short-turn = { $angle }° to the { $side ->
    [left] left
   *[right] right
}
short-run = straight for { $length }
repeat-pattern = In turn: { $moves }, each as the walls lead.
repeat-times = Do that { $times } times in all, one after the other.
thread-bead = Thread the bead of { $size } onto wire { $wire } first, and slide it up to { $at }, before you bend on.
bead-at-end = Only the wire’s end holds it: when the piece is out of the jig, turn that end into a small loop close behind the bead.
sew-bead = On the { $side ->
    [left] left
   *[right] right
  }, at { $at }, lies the bead of { $size }: when all wires are tied, sew it to this one there with a few turns of binding wire.
note-over = It passes over { $under } at { $places }.
note-beside = { $way ->
    [back] Go back along the same line
    [again] Go along the same line once more
   *[other] Go along the same line as wire { $wire }
}, on its { $side ->
    [left] left
   *[right] right
}, close beside the run that lies there: from { $start } to { $end } on the wire.
note-leave-room = From { $start } to { $end } on the wire, leave room as wide as the wire on its { $side ->
    [left] left
   *[right] right
}: later { $way ->
    [back] it comes back there, close beside itself.
    [again] it comes along there once more, close beside itself.
   *[other] wire { $wire } comes to lie there, close beside it.
}
note-bridge = This stretch is a bridge that the drawing doesn’t have: it holds the piece together.
tie-at = { $letter } ({ $at })
note-many-ties = On the way are { $count } places to tie later.
note-ties = { $count ->
    [one] On the way is a place to tie later: { $places }.
   *[other] On the way are places to tie later: { $places }.
}
span = From { $start } to { $end } on the wire.

## What the jig leaves to the hand
caution-strays = At { $places }: pulled tight, the wire would cut the corner. Press it to the line with your thumb, and hold it while you go on.
caution-hemmed = At { $places }: walls stand close by on both sides. Press the wire in with a rounded stick.
caution-weak-turn = At { $places }: little wall holds this bend. Make it with round-nose pliers before you lay it.
caution-weak-stretch = At { $places }: little wall holds this run. Keep it straight by hand.
caution-turn-without-wall = At { $places }: no wall fits inside this bend. Make it with round-nose pliers before you lay it.
caution-loose-end = At { $places }: the end is hardly held. Keep it in pliers until it is bent down into its hole.
caution-bead-between-runs = At { $places }: another run lies close beside the bead’s wire. Bend that run round the bead by hand.
caution-no-peg = At { $places }: no peg stands right for this bend. Make it by hand over the drawing.

## Ending a wire
heading-end = End wire { $wire }
end-run = Go straight on for { $length }.
end-hole = Bend the end down through the hole there, and flat below the plate. The wire is laid.
end-same-hole = You are back at hole { $hole }: bend the end down through it, and flat below the plate. The wire is laid.
end-numbered-hole = Bend the end down through hole { $hole }, which is there, and flat below the plate. The wire is laid.
end-mark = Mark the wire where the line ends. What is left is the tail.

## Lifting out
heading-lift = { $count ->
    [one] Lift it out
   *[other] Lift them out
}
lift-press = Press the wire down and close to the walls once more, all along.
lift-tape = Stick strips of tape across, so that the wires stay as they lie on one another.
lift-anchored = { $count ->
    [one] Straighten the tails below the plate, push them up out of their holes, and lift the wire out.
   *[other] Straighten all tails below the plate, push them up out of their holes, and lift the wires out together.
}
lift-board = { $count ->
    [one] Pull the pegs, and take the wire off.
   *[other] Pull the pegs, and take the wires off together.
}
lift-beads = { $count ->
    [one] The bead stays in the wires.
   *[other] The beads stay in the wires.
}
heading-again = Once more like wire { $wire }
again-like = Make this wire like wire { $wire }, step by step, in the same place.
again-lift = Lift it out.
again-mirrored = Turn it over: it is the mirror image.
again-reversed = In the piece it lies end for end: what was its end here is its start there.

## Putting together
heading-place = Lay { $wires }
place-first = { $count ->
    [one] Lay { $wires } flat on the table.
   *[other] Lay { $wires } flat on the table, together as they came out of the jig.
}
place-joined = Lay { $wires } in { $count ->
    [one] its
   *[other] their
} place, on { $others }.
place-alone = Lay { $wires } in { $count ->
    [one] its
   *[other] their
} place. Nothing that lies there touches it yet, so hold it with tape.
heading-tie = Tie { $letters }
tie-wires = { $letter } ({ $wires })
tie-itself = { $letter } (wire { $wire } to itself)
tie-where = Tie at { $places }.
tie-how = { $count ->
    [one] Take { $length } of binding wire, and wind { $turns } tight turns round the { $strands } strands that lie side by side there.
   *[other] For each take { $length } of binding wire, and wind { $turns } tight turns round the { $strands } strands that lie side by side there.
}
heading-ends = Finish the ends
ends-straighten = Pull the tails straight with flat-nose pliers.
ends-closed = { $count ->
    [one] Both tails of { $wires } meet: wind each once round the other’s beginning
   *[other] Both tails of each of { $wires } meet: wind each once round the other’s beginning
}, cut it and press it flat.
ends-wound-all = Wind every tail once round the wire that it meets, cut it, and press the end flat.
ends-wound = Some tails end at a tie: { $tails }. Wind each once round the wire that it meets there, cut it, and press the end flat.
ends-turned-all = Cut every tail to { $left }, and turn it in to a small loop with round-nose pliers.
ends-turned = Some tails end free: { $tails }. Cut each to { $left }, and turn it in to a small loop with round-nose pliers.
ends-binding = Press the ends of the binding wire flat and cut them off, so that nothing scratches.
tail-start = wire { $wire } (start)
tail-end = wire { $wire } (end)
tail-both = wire { $wire } (both)
heading-ring = The jump ring
ring-open = Open the jump ring sideways, hook it round the wire where the picture shows the open circle, and close it.

## What pictures show, for who can’t see them
picture-step = Wire { $wire } from { $start } to { $end }: what lies already, and what is done now
picture-lift = The jig with { $wires } laid in
picture-place = The piece with { $wires } laid in place
picture-tie = The piece with the ties { $letters }
picture-finished = The finished piece
picture-ring = The piece with the place of its jump ring

## The print
print-scale = Print at 100 %, “actual size”. Then measure: the first line is { $mm } mm long, the second { $inches } in.
tile = { $name }, part { $part } of { $parts }: lay the crosses of neighbouring parts on one another
strip-how = Lay each wire along its strip and mark it: S is where the shape starts, E where it ends; a bar is a bend, with the number of its step; a letter is a tie.
strip-title = { $wire }, { $length }
strip-part = { $wire }, { $length }, part { $part } of { $parts }: lay the triangles on one another
page-of = page { $page } of { $pages }
