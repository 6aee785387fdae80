# Alle Texte der Anleitung auf Deutsch, mit denselben Schlüsseln wie en.ftl.

## Die Seite selbst
language = de
page-title = { $name }: so wird es gemacht
contents = Inhalt
steps-title = Schritt für Schritt
all-steps = Alle Schritte
one-step = Ein Schritt nach dem anderen
back = Zurück
next = Weiter
step-of = { $step } von { $steps }
progress = Wie weit du bist
get-ready = Vorbereiten
strips-title = Messstreifen
true-size-title = Das Stück in wahrer Größe
caution = Achtung

## Größen und Aufzählungen
and = und
or = oder
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
wire-number = Draht { $wire }
wire-capital = Draht { $wire }
wire-at = Draht { $wire } bei { $at }
itself = sich selbst

## Erste Seite
lead = { $pieces ->
    [one] { $wires ->
        [one] Ein Draht
       *[other] { $wires } Drähte
    }
   *[other] Ein Paar aus je { $wires ->
        [one] einem Draht
       *[other] { $wires } Drähten
    }
}, { $ties ->
    [0] keine Bindestellen
    [one] eine Bindestelle
   *[other] { $ties } Bindestellen
}; fertige Größe { $x } × { $y }.
cover-picture = Das fertige Stück mit seinen Drähten in verschiedenen Farben, nummeriert am Anfang
cover-caption = Das fertige Stück. Jede Farbe ist ein Draht; seine Nummer steht, wo er beginnt.{ $ring ->
    [yes] {" "}Der offene Kreis zeigt, wohin der Bindering kommt.
   *[no] {""}
}

## Material
materials-title = Was du brauchst
materials-table = Metall
materials-head-what = Material
materials-head-thickness = Dicke
materials-head-length = Insgesamt
materials-head-weight = Gewicht
material-frame = Draht aus { $metal }, { $temper }, für die Form
material-binding = Draht aus { $metal }, weich geglüht, zum Binden
material-ring = { $count ->
    [one] Bindering aus { $metal }
   *[other] { $count } Binderinge aus { $metal }
}, innen { $inside }; oder um einen Stab dieser Dicke biegen
metal-copper = Kupfer
metal-brass = Messing
metal-bronze = Bronze
metal-sterling-silver = Sterlingsilber
metal-fine-silver = Feinsilber
metal-gold-filled = Goldfilled
metal-aluminium = Aluminium
metal-steel = Stahl
temper-dead-soft = weich geglüht
temper-half-hard = halbhart
temper-hard = hart
beads-table = Perlen
beads-head-size = Größe
beads-head-count = Anzahl
cut-table = Zuschnitt
cut-head-wire = Draht
cut-head-cut = Ablängen
cut-head-tail = Je Überstand
cut-head-shape = Form
cut-pieces = { $count ->
    [one] { $length }
   *[other] { $count } × { $length }
}
tools = Seitenschneider, Flachzange, Rundzange, Lineal, feiner Stift, Klebeband.
tools-jig = { $board ->
    [yes] Das Brett mit seinen Stiften.
   *[no] { $count ->
        [one] Die Schablone.
       *[other] { $count } Schablonen.
    }
}
tools-jigs = Sie heißen { $names }.
fact-difficulty = Schwierigkeit
difficulty-easy = leicht: ein erstes Stück
difficulty-medium = mittel: nimm dir Zeit
difficulty-hard = schwer: für geübte Hände
fact-time = Zeit
time-about = etwa { $time }, wenn die Schablone fertig ist

## Die Schablone drucken
other-jig = Eine Schablone genügt: diese, oder die von „{ $title }“, welche die Schritte zeigen.
print-title = { $jigs ->
    [one] Die Schablone drucken
   *[other] Die Schablonen drucken
}
print-how = { $jigs ->
    [one] Sie liegt
   *[other] Jede liegt
} in der Datei so, wie sie gedruckt wird: Platte unten, Wände oben, ohne Stützen. Lass den Maßstab bei 100 %; der Slicer darf sie nicht ans Druckbett anpassen.
print-clean = Wenn sie abgekühlt ist, schieb ein Stück des Drahts durch jedes Loch, und kratz weg, was am Fuß der Wände übersteht: der Draht muss flach auf der Platte liegen.
jig-for = { $jig }: für { $count ->
    [one] Draht { $wires }
   *[other] die Drähte { $wires }
}
jig-picture = { $jig } von oben: Wände, Löcher und die Drähte, nummeriert am Anfang
jig-caption = Die Schablone von oben. Braun sind ihre Wände, die farbigen Linien die Drähte; jede Nummer steht am Loch, in dem dieser Draht beginnt.
fact-file = Datei
file-one-of = { $files }
file-none = keine verlangt: 3mf in outputs aufnehmen
file-none-flat = keine verlangt: dxf in outputs aufnehmen
fact-other-earring = Anderer Ohrring
file-mirrored = { $count ->
    [0] keine verlangt: 3mf in outputs aufnehmen
   *[other] { $files }: das Spiegelbild
}
fact-material = Material
print-material = PLA oder PETG
fact-settings = Einstellungen
print-settings = Schichten von 0,2 mm, zwei Umrandungen, 20 % Füllung, keine Stützen
fact-size = Größe
fact-takes = Braucht etwa
takes-about = { $time }, { $mass }
pins-how = { $pins ->
    [one] Eine Biegung ist zu eng für eine Wand. Steck einen Nagel oder ein Stück Stab in das kleine Loch darin und bieg den Draht darum:
   *[other] Einige Biegungen sind zu eng für eine Wand. Steck einen Nagel oder ein Stück Stab in das kleine Loch in jeder und bieg den Draht darum:
}
pin-line = Draht { $wire }, { $at } nach der Anfangsmarke: { $rod } dick

## Die gelaserte Schablone kleben
glue-title = Die Schablone schneiden und kleben
glue-how = Die Schablone wird aus Plattenmaterial geschnitten und wie eine Einlegearbeit geklebt: eine Bodenplatte, darauf eine Platte mit Taschen, und Wandstücke, die in die Taschen passen. Du brauchst Holzleim (oder Acrylkleber), Zahnstocher als Stifte und Zwingen.
glue-sheets = Platten zum Schneiden
glue-head-sheet = Platte
glue-head-thickness = Dicke
glue-head-size = Größe
glue-head-parts = Teile
glue-head-file = Datei
glue-leave = Lass die Teile in der Platte, bis du sie brauchst, oder beschrifte sie beim Herausnehmen: bei den kleinsten steht die Nummer daneben in der Platte.
glue-pair = Die Platten sind für einen der beiden Ohrringe. Für den anderen spiegle die Zeichnung im Programm des Lasers.
glue-picture = Plan von { $jig }: die Platte mit ihren nummerierten Wandstücken
glue-caption = Wohin jedes Stück kommt. Die farbigen Linien sind die Drähte; sie sind auch in die Platte graviert.
glue-bottom = Leg die Bodenplatte { $part } auf den Tisch, Gravur nach oben. Sie zeigt die Nummer jedes Wandstücks dort, wo seine Tasche sein wird.
glue-plate = Streich einen dünnen Film Leim um die Nummern. Leg Platte { $part } darauf, Gravur nach oben, und steck einen Stift durch jedes der drei Ecklöcher: sie passt nur auf eine Art. Wisch Leim aus den Taschen, drück sie flach und zieh die Stifte heraus.
glue-wall = Kleb { $count ->
    [one] Wandstück { $parts }, Nummer nach oben, in seine Tasche
   *[other] die Wandstücke { $parts }, Nummern nach oben, in ihre Taschen
}{ $where ->
    [in] {" "}innerhalb von Stück { $inside }
   *[plate] {""}
}.{ $copies ->
    [one] {""}
    [2] {" "}Kleb von jedem das zweite bündig darauf.
   *[other] {" "}Kleb von jedem die anderen { $more } bündig darauf.
}
glue-island = Kleb { $count ->
    [one] die kleine Platte { $parts }
   *[other] die kleinen Platten { $parts }
}, Gravur nach oben, in das Loch { $where ->
    [in] innerhalb von Stück { $inside }
   *[plate] der Platte
}.
glue-dry = Beschwer alles, bis der Leim trocken ist. Die Wände stehen nun { $height } über der Platte.

## Das Brett mit Stiften
pegs-title = Das Brett mit Stiften bestücken
pegs-how = Das Brett hat { $columns } Spalten und { $rows } Reihen von Löchern im Abstand von { $pitch }; die Spalten haben von links Buchstaben, die Reihen von unten Zahlen.
pegs-file = Die Zeichnung ({ $files }) zeigt es in wahrer Größe: leg sie unter ein durchsichtiges Brett oder halt sie an deines.
pegs-pair = Dies ist das Brett für einen der beiden Ohrringe. Für den anderen spiegle es: die Spalten haben ihre Buchstaben dann von rechts.
pegs-picture = Das Brett mit seinen Stiften und den Drähten, die darum gebogen sind
pegs-caption = Die Stifte stehen innen in den Biegungen; die farbigen Linien sind die Drähte.
pegs-table = Stifte
pegs-head-hole = Loch
pegs-head-peg = Stift
pegs-head-round = Darum biegen
pegs-unserved = { $turns ->
    [one] Für eine Biegung steht kein Stift richtig; mach sie von Hand über der Zeichnung:
   *[other] Für diese Biegungen steht kein Stift richtig; mach sie von Hand über der Zeichnung:
}

## Wie die Schritte zu lesen sind
read-steps = Links und rechts sind so gemeint, wie du dem Draht von seinem Anfang her folgst, von oben gesehen. In den Bildern ist die Linie mit dunklem Rand das, was du jetzt tust, mit einem Pfeil an ihrem Ende; was schon liegt, ist farbig, was später kommt, blass; die Wände dazu sind dunkel.
chapter-wire = { $which ->
    [other] Der andere Ohrring: Draht { $wire } von { $wires }
   *[first] Draht { $wire } von { $wires }
}
chapter-together = { $which ->
    [other] Der andere Ohrring: zusammensetzen
   *[first] Zusammensetzen
}

## Einen Draht beginnen
heading-start = Draht { $wire } beginnen
take-jig = Nimm { $jig }.
set-beads = { $count ->
    [one] Setz die Perle oder den Stein ({ $sizes } dick) in den Sitz.
   *[other] Setz die Perlen oder Steine ({ $sizes } dick) in ihre Sitze.
}
start-cut = Schneid { $cut } Draht ab, und markier ihn { $tail } von einem Ende: das ist der Überstand, und an der Marke beginnt die Form.
start-hole = Steck den Überstand bis zur Marke durch Loch { $hole }, und bieg ihn unter der Platte flach um: so hält er den Draht, und die Schablone liegt flach.
start-board = Halt die Marke über den Anfang auf der Zeichnung, mit Klebeband über dem Überstand.
start-hand = Leg die Marke auf den Anfang in der Zeichnung in wahrer Größe, mit Klebeband über dem Überstand.
start-unmarked = Für eine gravierte { $hole } neben dem Loch war kein Platz: das Bild zeigt es.
start-way = Führ den Draht { $way }, wie im Bild.
way-right = nach rechts
way-upper-right = nach rechts oben
way-up = nach oben
way-upper-left = nach links oben
way-left = nach links
way-lower-left = nach links unten
way-down = nach unten
way-lower-right = nach rechts unten
spring-made-up = Die Schablone biegt den Draht etwas weiter, als das Stück zeigt, nämlich um das, was das Metall zurückfedert: drück ihn dicht an die Wände, heb ihn dann heraus, und lass ihn los.
spring-further = Das Metall federt etwas zurück: bieg einen rechten Winkel mit einem Radius von { $radius } etwa { $angle }° weiter als nötig.

## Einen Draht entlang
heading-wrap = Nach { $side ->
    [left] links
   *[right] rechts
} wickeln
heading-bend = Nach { $side ->
    [left] links
   *[right] rechts
} biegen
heading-curve = Bogen nach { $side ->
    [left] links
   *[right] rechts
}
heading-fold = Zurückfalten
heading-hairpin = Zurückbiegen
heading-loop = Eine Schlaufe
heading-spiral = Eine Spirale
heading-bail = Die Öse zum Aufhängen
heading-repeat = { $times }-mal dasselbe
lead-on = Geh { $length } gerade weiter.
lead-to-wall = Geh { $length } gerade weiter bis zur Wand { $side ->
    [left] links
   *[right] rechts
}.
lead-to-pin = Geh { $length } gerade weiter bis zum Stift { $side ->
    [left] links
   *[right] rechts
}.
lead-to-run = Geh { $length } gerade weiter, dicht neben dem Lauf { $side ->
    [left] links
   *[right] rechts
}.
lead-to-peg = Geh { $length } gerade weiter bis zum Stift in { $hole }.
do-wrap-wall = Wickle den Draht stramm um die { $walls ->
    [one] Wand
   *[other] Wände
} { $side ->
    [left] links
   *[right] rechts
} von ihm, um etwa { $angle }°: { $length } Draht, Radius { $radius }.
do-wrap-pin = Wickle den Draht nach { $side ->
    [left] links
   *[right] rechts
} um den Stift ({ $rod }), um etwa { $angle }°.
do-wrap-run = Bieg ihn nach { $side ->
    [left] links
   *[right] rechts
} um den Lauf, der dort liegt, dicht daneben, um etwa { $angle }°: { $length } Draht.
do-wrap-peg = Wickle den Draht nach { $side ->
    [left] links
   *[right] rechts
} um den Stift in { $hole } ({ $rod }), um etwa { $angle }°.
do-bend = Bieg ihn mit der Rundzange um etwa { $angle }° nach { $side ->
    [left] links
   *[right] rechts
}.
do-curve = Lass ihn in einem Bogen nach { $side ->
    [left] links
   *[right] rechts
} laufen: etwa { $angle }° auf { $length }.
do-by-hand-curve = Bieg mit den Fingern einen Bogen nach { $side ->
    [left] links
   *[right] rechts
}: etwa { $angle }° auf { $length }, Radius { $radius }.
do-fold = Falt ihn mit der Flachzange nach { $side ->
    [left] links
   *[right] rechts
} zurück, etwa { $angle }°.
do-hairpin = Bieg mit der Rundzange eine enge Schlaufe nach { $side ->
    [left] links
   *[right] rechts
}, etwa { $angle }°, Radius { $radius }, sodass der Draht dicht neben sich selbst zurückkommt.
do-hairpin-wall = Bieg eine enge Schlaufe nach { $side ->
    [left] links
   *[right] rechts
} stramm um die Wand darin, etwa { $angle }°, sodass der Draht dicht neben sich selbst zurückkommt.
do-hairpin-pin = Bieg eine enge Schlaufe nach { $side ->
    [left] links
   *[right] rechts
} um den Stift darin ({ $rod }), etwa { $angle }°, sodass der Draht dicht neben sich selbst zurückkommt.
do-hairpin-peg = Bieg eine enge Schlaufe nach { $side ->
    [left] links
   *[right] rechts
} um den Stift in { $hole } ({ $rod }), etwa { $angle }°, sodass der Draht dicht neben sich selbst zurückkommt.
do-loop = Mach eine Schlaufe nach { $side ->
    [left] links
   *[right] rechts
}, etwa { $angle }°: { $length } Draht, Radius { $radius }.
do-spiral = Wickle eine Spirale nach { $side ->
    [left] links
   *[right] rechts
}: etwa { $turns } Windungen, { $length } Draht.
do-bail = Bieg den Hals und die Öse zum Aufhängen, um einen Stab von { $rod } oder den Pfosten in der Schablone ({ $length } Draht). Wenn das Stück zusammengesetzt ist, wickle den Überstand zweimal um den Hals.
short-turn = { $angle }° nach { $side ->
    [left] links
   *[right] rechts
}
short-run = { $length } gerade
repeat-pattern = Im Wechsel: { $moves }, je nachdem, wie die Wände führen.
repeat-times = Mach das insgesamt { $times }-mal hintereinander.
thread-bead = Fädel zuerst die Perle von { $size } auf Draht { $wire }, und schieb sie bis { $at }, ehe du weiterbiegst.
bead-at-end = Nur das Drahtende hält sie: wenn das Stück aus der Schablone ist, bieg dieses Ende dicht hinter der Perle zu einer kleinen Öse.
sew-bead = { $side ->
    [left] Links
   *[right] Rechts
  } davon, bei { $at }, liegt die Perle von { $size }: wenn alle Drähte gebunden sind, binde sie dort mit ein paar Windungen Bindedraht an diesen.
note-over = Er läuft über { $under } bei { $places }.
note-beside = { $way ->
    [back] Geh auf derselben Linie zurück
    [again] Geh noch einmal dieselbe Linie entlang
   *[other] Geh dieselbe Linie entlang wie Draht { $wire }
}, { $side ->
    [left] links
   *[right] rechts
} von ihr, dicht neben dem Lauf, der dort liegt: von { $start } bis { $end } auf dem Draht.
note-leave-room = Lass von { $start } bis { $end } auf dem Draht { $side ->
    [left] links
   *[right] rechts
} davon so viel Platz, wie der Draht dick ist: später { $way ->
    [back] kommt er dort zurück, dicht neben sich selbst.
    [again] geht er dort noch einmal entlang, dicht neben sich selbst.
   *[other] kommt Draht { $wire } dort dicht daneben zu liegen.
}
note-bridge = Dieses Stück ist eine Brücke, die die Zeichnung nicht hat: sie hält das Ganze zusammen.
tie-at = { $letter } ({ $at })
note-many-ties = Unterwegs liegen { $count } Stellen zum späteren Binden.
note-ties = { $count ->
    [one] Unterwegs liegt eine Stelle zum späteren Binden: { $places }.
   *[other] Unterwegs liegen Stellen zum späteren Binden: { $places }.
}
span = Von { $start } bis { $end } auf dem Draht.

## Was die Schablone der Hand überlässt
caution-strays = Bei { $places }: stramm gezogen würde der Draht die Ecke abschneiden. Drück ihn mit dem Daumen an die Linie, und halt ihn, während du weitermachst.
caution-hemmed = Bei { $places }: auf beiden Seiten stehen Wände dicht dabei. Drück den Draht mit einem runden Stäbchen hinein.
caution-weak-turn = Bei { $places }: wenig Wand hält diese Biegung. Mach sie mit der Rundzange, bevor du sie legst.
caution-weak-stretch = Bei { $places }: wenig Wand hält dieses Stück. Halt es von Hand gerade.
caution-turn-without-wall = Bei { $places }: in diese Biegung passt keine Wand. Mach sie mit der Rundzange, bevor du sie legst.
caution-loose-end = Bei { $places }: das Ende wird kaum gehalten. Halt es mit der Zange, bis es in sein Loch gebogen ist.
caution-bead-between-runs = Bei { $places }: neben dem Draht der Perle liegt dicht ein anderer Lauf. Bieg diesen von Hand um die Perle.
caution-no-peg = Bei { $places }: für diese Biegung steht kein Stift richtig. Mach sie von Hand über der Zeichnung.

## Einen Draht enden lassen
heading-end = Draht { $wire } beenden
end-run = Geh { $length } gerade weiter.
end-hole = Bieg das Ende nach unten durch das Loch dort, und unter der Platte flach um. Der Draht liegt.
end-same-hole = Du bist wieder bei Loch { $hole }: bieg das Ende nach unten hindurch, und unter der Platte flach um. Der Draht liegt.
end-numbered-hole = Bieg das Ende nach unten durch Loch { $hole }, das dort ist, und unter der Platte flach um. Der Draht liegt.
end-mark = Markier den Draht, wo die Linie endet. Was bleibt, ist der Überstand.

## Herausheben
heading-lift = { $count ->
    [one] Heb ihn heraus
   *[other] Heb sie heraus
}
lift-press = Drück den Draht noch einmal überall nach unten und an die Wände.
lift-tape = Kleb Streifen Klebeband quer darüber, damit die Drähte so aufeinander liegen bleiben.
lift-anchored = { $count ->
    [one] Richte die Überstände unter der Platte gerade, schieb sie nach oben aus ihren Löchern, und heb den Draht heraus.
   *[other] Richte alle Überstände unter der Platte gerade, schieb sie nach oben aus ihren Löchern, und heb die Drähte zusammen heraus.
}
lift-board = { $count ->
    [one] Zieh die Stifte heraus, und nimm den Draht ab.
   *[other] Zieh die Stifte heraus, und nimm die Drähte zusammen ab.
}
lift-beads = { $count ->
    [one] Die Perle bleibt in den Drähten.
   *[other] Die Perlen bleiben in den Drähten.
}
heading-again = Noch einmal wie Draht { $wire }
again-like = Mach diesen Draht Schritt für Schritt wie Draht { $wire }, am selben Ort.
again-lift = Heb ihn heraus.
again-mirrored = Dreh ihn um: er ist das Spiegelbild.
again-reversed = Im Stück liegt er andersherum: was hier sein Ende war, ist dort sein Anfang.

## Zusammensetzen
heading-place = { $wires } auflegen
place-first = { $count ->
    [one] Leg { $wires } flach auf den Tisch.
   *[other] Leg { $wires } flach auf den Tisch, zusammen, wie sie aus der Schablone kamen.
}
place-joined = Leg { $wires } an { $count ->
    [one] seinen
   *[other] ihren
} Platz, auf { $others }.
place-alone = Leg { $wires } an { $count ->
    [one] seinen
   *[other] ihren
} Platz. Noch berührt nichts, was dort liegt; halt es mit Klebeband fest.
heading-tie = { $letters } binden
tie-wires = { $letter } ({ $wires })
tie-itself = { $letter } (Draht { $wire } mit sich selbst)
tie-where = Bind bei { $places }.
tie-how = { $count ->
    [one] Nimm { $length } Bindedraht, und wickle ihn { $turns }-mal stramm um die { $strands } Stränge, die dort nebeneinander liegen.
   *[other] Nimm für jede { $length } Bindedraht, und wickle ihn { $turns }-mal stramm um die { $strands } Stränge, die dort nebeneinander liegen.
}
heading-ends = Die Enden
ends-straighten = Zieh die Überstände mit der Flachzange gerade.
ends-closed = { $count ->
    [one] Beide Überstände von { $wires } treffen sich: wickle jeden einmal um den Anfang des anderen
   *[other] Beide Überstände von { $wires } treffen sich jeweils: wickle jeden einmal um den Anfang des anderen
}, schneid ihn ab und drück ihn flach.
ends-wound-all = Wickle jeden Überstand einmal um den Draht, auf den er trifft, schneid ihn ab, und drück das Ende flach.
ends-wound = Einige Überstände enden an einer Bindestelle: { $tails }. Wickle jeden einmal um den Draht, auf den er dort trifft, schneid ihn ab, und drück das Ende flach.
ends-turned-all = Kürz jeden Überstand auf { $left }, und roll ihn mit der Rundzange zu einer kleinen Öse ein.
ends-turned = Einige Überstände enden frei: { $tails }. Kürz jeden auf { $left }, und roll ihn mit der Rundzange zu einer kleinen Öse ein.
ends-binding = Drück die Enden des Bindedrahts flach und schneid sie ab, damit nichts kratzt.
tail-start = Draht { $wire } (Anfang)
tail-end = Draht { $wire } (Ende)
tail-both = Draht { $wire } (beide)
heading-ring = Der Bindering
ring-open = Bieg den Bindering seitlich auf, häng ihn um den Draht, wo das Bild den offenen Kreis zeigt, und schließ ihn.

## Was Bilder zeigen, für alle, die sie nicht sehen
picture-step = Draht { $wire } von { $start } bis { $end }: was schon liegt, und was jetzt getan wird
picture-lift = Die Schablone mit { $wires } darin
picture-place = Das Stück mit { $wires } an seinem Platz
picture-tie = Das Stück mit den Bindestellen { $letters }
picture-finished = Das fertige Stück
picture-ring = Das Stück mit dem Ort seines Binderings

## Der Druck
print-scale = Druck mit 100 %, „tatsächliche Größe“. Dann miss nach: die erste Linie ist { $mm } mm lang, die zweite { $inches } Zoll.
tile = { $name }, Teil { $part } von { $parts }: leg die Kreuze benachbarter Teile aufeinander
strip-how = Leg jeden Draht an seinen Streifen, und markier ihn: S ist, wo die Form beginnt, E, wo sie endet; ein Balken ist eine Biegung mit der Nummer ihres Schritts; ein Buchstabe ist eine Bindestelle.
strip-title = { $wire }, { $length }
strip-part = { $wire }, { $length }, Teil { $part } von { $parts }: leg die Dreiecke aufeinander
page-of = Seite { $page } von { $pages }
