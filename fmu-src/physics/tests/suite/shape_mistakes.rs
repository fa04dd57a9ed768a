//! What is written wrongly of a shape is refused with its line, key, what was found and what is allowed.

use physics::spacecraft::Spacecraft;

use super::shapes::HEAD;

#[test]
fn what_is_no_shape_is_refused_by_its_place() {
    let cylinder = "[[cylinders]]\ncenter_m = [0, 0, 0]\nradius_m = 1\nheight_m = 1\noptics = 'grey'\n";
    let dish =
        "[[dishes]]\nvertex_m = [0, 0, 0]\naxis = [0, 0, 1]\nradius_m = 1\ndepth_m = 1\noptics = 'grey'\n";
    let cube = "[[boxes]]\ncenter_m = [0, 0, 0]\nsize_m = [1, 1, 1]\noptics = 'grey'\n";
    let plate = "[[plates]]\nname = 'bus.+X'\narea_m2 = 1\ncenter_m = [0, 0, 0]\nnormal = [0, 0, 1]\noptics = 'grey'\n";
    let line = HEAD.lines().count();
    let cases: &[(String, &str)] = &[
        (
            cube.replace("[1, 1, 1]", "[1, 0, 1]"),
            ":+3: boxes[1].size_m[2]: found 0, allowed: a number above 0 and at most 1e12",
        ),
        (
            cube.replace("[1, 1, 1]", "[1, 1]"),
            ":+3: boxes[1].size_m: found a list of length 2, allowed: a list of length 3",
        ),
        (
            cube.replace("[1, 1, 1]", "[1e12, 1, 1e-3]"),
            ":+1: boxes[1]: found lengths that make no outline of `+Y` (vertices 1 and 2 in one place, allowed: \
             distinct vertices), allowed: lengths within a factor of 1e8 of one another",
        ),
        (
            format!("{cube}face_optics = {{'+x' = 'grey'}}\n"),
            ":+5: boxes[1].face_optics.\"+x\": found the unknown face `+x` (did you mean `+X`?), allowed: \
             +X, -X, +Y, -Y, +Z, -Z",
        ),
        (
            format!("{cube}open_faces = ['up']\n"),
            ":+5: boxes[1].open_faces[1]: found the unknown word `up` (did you mean `+X`?), allowed: +X, -X, +Y, -Y, +Z, -Z",
        ),
        (
            format!("{cube}face_optics = {{'+X' = 'grey'}}\nopen_faces = ['+X']\n"),
            ":+5: boxes[1].face_optics.\"+X\": found a face that is open too, allowed: a face that the box has",
        ),
        (
            format!("{cube}open_faces = ['+X', '-X', '+Y', '-Y', '+Z', '-Z']\n"),
            ":+1: boxes[1]: found 0 faces, allowed: 1 to 2000",
        ),
        (
            cube.replace("grey", "gray"),
            ":+4: boxes[1].optics: found the unknown material `gray` (did you mean `grey`?), allowed: a material under \
             [optics]: black, grey, mirror, white",
        ),
        (
            cylinder.replace("radius_m = 1", "radius_m = -1"),
            ":+3: cylinders[1].radius_m: found -1, allowed: a number above 0 and at most 1e12",
        ),
        (
            cylinder.replace("radius_m = 1", "diameter_m = 2"),
            ":+1: cylinders[1]: found no key `radius_m`, allowed: a value for `radius_m`, which has no default\n\
             :+3: cylinders[1].diameter_m: found the unknown key `diameter_m`, allowed: name, center_m, axis, radius_m, \
             height_m, facets, optics, end_optics, rear_optics, open_ends, thermal, mirror, repeat",
        ),
        (
            format!("{cylinder}facets = 2\n"),
            ":+6: cylinders[1].facets: found 2, allowed: a whole number from 3 to 128",
        ),
        (
            format!("{cylinder}axis = [0, 1, 1]\n"),
            ":+6: cylinders[1].axis: found [0.0, 1.0, 1.0] of length 1.41421356237, allowed: a unit vector \
             (length 1 within 1e-3; it is then renormalised), here [0, 0.707107, 0.707107]",
        ),
        (
            format!("{cylinder}thermal.conduction.conductance_w_m2_k = 3\n"),
            ":+6: cylinders[1].thermal.conduction: found a surface without `rear_optics`, allowed: a surface with both \
             faces",
        ),
        (format!("{dish}rings = 0\n"), ":+7: dishes[1].rings: found 0, allowed: a whole number from 1 to 32"),
        (
            format!("{dish}facets = 100\nrings = 30\n"),
            ":+1: dishes[1]: found 3000 facets, allowed: 1 to 2000",
        ),
        (
            format!("{cube}mirror = ['x']\n"),
            ":+1: boxes[1]: found `box 1[2].+X` in the place of `box 1[1].-X`, allowed: copies that lie apart",
        ),
        (
            format!("{cube}mirror = ['x', 'x']\n").replace("[0, 0, 0]", "[2, 0, 0]"),
            ":+5: boxes[1].mirror[2]: found the same plane again, allowed: each of x, y, z once",
        ),
        (
            format!("{cube}mirror = 'x'\n"),
            ":+5: boxes[1].mirror: found string \"x\", allowed: a list: [\"x\"]",
        ),
        (
            format!("{cube}repeat = {{count = 1, step_m = [0, 1, 0]}}\n"),
            ":+5: boxes[1].repeat.count: found 1, allowed: a whole number from 2 to 100",
        ),
        (
            format!("{cube}repeat = {{count = 2}}\n"),
            ":+5: boxes[1].repeat: found neither `step_m` nor `axis`, allowed: one of them",
        ),
        (
            format!("{cube}repeat = {{count = 2, step_m = [0, 2, 0], axis = [0, 0, 1]}}\n"),
            ":+5: boxes[1].repeat: found both `step_m` and `axis`, allowed: one of them",
        ),
        (
            format!("{cube}repeat = {{count = 2, step_m = [0, 2, 0], angle_deg = 9}}\n"),
            ":+5: boxes[1].repeat.angle_deg: found no `axis` beside it, allowed: with `axis` alone",
        ),
        (
            format!("{plate}{cube}name = 'bus'\n"),
            ":+11: boxes[1].name: found a plate `bus.+X`, as plates[1] has, allowed: a name whose plates have names of \
             their own",
        ),
        (
            format!("{cube}name = 'bus'\n{}name = 'bus'\n", dish),
            ":+12: dishes[1].name: found `bus`, the name of boxes[1] too, allowed: a name of its own",
        ),
    ];
    let mut wrong = Vec::new();
    for (surfaces, expected) in cases {
        let text = format!("{HEAD}{surfaces}");
        let found = Spacecraft::from_toml("a.toml", &text)
            .map_or_else(|error| error.to_string(), |_| "good".to_owned());
        let expected = expected.split(":+").skip(1).map(|part| {
            let (more, rest) = part.split_once(':').unwrap();
            format!("a.toml:{}:{rest}", line + more.parse::<usize>().unwrap())
        });
        let expected = expected.collect::<Vec<_>>().concat();
        if found != expected {
            wrong.push(format!("{surfaces}\nfound    {found}\nexpected {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
