//! The picture of a spinner: left from aside with the spin axis upwards, right along the spin axis from +Z.
//!
//! Its file describes no body, so a cylinder through the outermost thrusters stands for it; each thruster stands where it
//! is and blows against its force.

use std::fmt::Write;

use super::canvas::{HEIGHT, MARGIN, WIDTH};
use crate::draw::vector::{Vector, dot, unit};

/// Lengths as parts of the cylinder's radius.
const NOZZLE: f64 = 0.16;
const PLUME: f64 = 0.30;
const THROAT_HALF_WIDTH: f64 = 0.03;
const EXIT_HALF_WIDTH: f64 = 0.08;
const PLUME_HALF_WIDTH: f64 = 0.19;
const AXIS_OVERHANG: f64 = 0.62;

/// Where a thruster is and where its jet goes, in the body frame.
struct Thruster {
    position_m: Vector,
    jet: Vector,
}

/// The cylinder in the body frame, about +Z.
struct Cylinder {
    radius_m: f64,
    low_m: f64,
    high_m: f64,
}

/// A direction of view: what is right, up and towards the viewer in the body frame, and where its middle stands.
struct View {
    right: Vector,
    up: Vector,
    viewer: Vector,
    middle: (f64, f64),
    middle_body_m: Vector,
    pixels_per_m: f64,
}

impl View {
    fn screen(&self, point: Vector) -> (f64, f64) {
        let from_middle: Vector = std::array::from_fn(|i| point[i] - self.middle_body_m[i]);
        let (x, y) = (dot(from_middle, self.right), dot(from_middle, self.up));
        (self.middle.0 + self.pixels_per_m * x, self.middle.1 - self.pixels_per_m * y)
    }
}

/// Draws it; `None` where no thruster is aside of the axis.
pub fn svg(thrusters: &[physics::spacecraft::Thruster]) -> Option<String> {
    let thrusters: Vec<Thruster> = thrusters
        .iter()
        .map(|thruster| {
            let force = unit(thruster.force_body_n.into())?;
            Some(Thruster { position_m: thruster.position_body_m.into(), jet: force.map(|x| -x) })
        })
        .collect::<Option<_>>()?;
    let cylinder = Cylinder::through(&thrusters)?;
    let middle_body_m = [0.0, 0.0, (cylinder.low_m + cylinder.high_m) / 2.0];
    let reach_m = cylinder.radius_m * (1.0 + NOZZLE + PLUME);
    let tall_m = (cylinder.high_m - cylinder.low_m) / 2.0 + cylinder.radius_m * AXIS_OVERHANG;
    let pixels_per_m =
        ((WIDTH / 2.0 - MARGIN) / (2.0 * reach_m)).min((HEIGHT - MARGIN) / (2.0 * tall_m.max(reach_m)));
    let view = |right, up, viewer, part: f64| View {
        right,
        up,
        viewer,
        middle: (WIDTH * part, HEIGHT / 2.0),
        middle_body_m,
        pixels_per_m,
    };
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let aside = view(x, z, [0.0, -1.0, 0.0], 0.25);
    let along = view(x, y, z, 0.75);

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\"><defs>\
         <linearGradient id=\"side\"><stop offset=\"0\" stop-color=\"#cfc4a9\"/>\
         <stop offset=\"0.35\" stop-color=\"#fff6e2\"/><stop offset=\"1\" stop-color=\"#a89d84\"/></linearGradient>\
         <linearGradient id=\"deck\" x2=\"1\" y2=\"1\"><stop offset=\"0\" stop-color=\"#fff6e2\"/>\
         <stop offset=\"1\" stop-color=\"#d9ceb4\"/></linearGradient></defs>\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>"
    );
    for (view, drawn_cylinder) in [(&aside, cylinder.side(&aside)), (&along, cylinder.deck(&along))] {
        let depth = |thruster: &Thruster| {
            let from_middle: Vector = std::array::from_fn(|i| thruster.position_m[i] - middle_body_m[i]);
            dot(from_middle, view.viewer)
        };
        let (behind, before): (Vec<_>, Vec<_>) = thrusters.iter().partition(|thruster| depth(thruster) < 0.0);
        svg.extend(behind.into_iter().map(|thruster| thruster.draw(view, &cylinder)));
        svg.push_str(&drawn_cylinder);
        svg.extend(before.into_iter().map(|thruster| thruster.draw(view, &cylinder)));
    }
    svg.push_str("</svg>");
    Some(svg)
}

impl Cylinder {
    fn through(thrusters: &[Thruster]) -> Option<Self> {
        let radii = thrusters.iter().map(|thruster| thruster.position_m[0].hypot(thruster.position_m[1]));
        let radius_m = radii.reduce(f64::max)?;
        let heights = || thrusters.iter().map(|thruster| thruster.position_m[2]);
        let (low, high) = (heights().reduce(f64::min)?, heights().reduce(f64::max)?);
        // Thrusters in one plane still need a body.
        let missing = (0.3 * radius_m - (high - low)).max(0.0) / 2.0;
        let cylinder = Self { radius_m, low_m: low - missing, high_m: high + missing };
        (cylinder.radius_m > 1e-9 && (cylinder.high_m - cylinder.low_m).is_finite()).then_some(cylinder)
    }

    /// From aside: the outline, and the spin axis with its sense.
    fn side(&self, view: &View) -> String {
        let (left, top) = view.screen([-self.radius_m, 0.0, self.high_m]);
        let (right, bottom) = view.screen([self.radius_m, 0.0, self.low_m]);
        let overhang_m = AXIS_OVERHANG * self.radius_m;
        let (x, end) = view.screen([0.0, 0.0, self.high_m + overhang_m]);
        let (_, start) = view.screen([0.0, 0.0, self.low_m - overhang_m / 2.0]);
        format!(
            "<path d=\"M{x:.2},{start:.2}V{end:.2}\" stroke=\"#0072b2\" stroke-width=\"1.6\" \
             stroke-dasharray=\"9 3 2 3\"/>\
             <rect x=\"{left:.2}\" y=\"{top:.2}\" width=\"{:.2}\" height=\"{:.2}\" rx=\"3\" fill=\"url(#side)\" \
             stroke=\"#2b3440\" stroke-width=\"1.4\"/>{}",
            right - left,
            bottom - top,
            arrow_head((x, end), (0.0, -1.0))
        )
    }

    /// Along the axis: the deck and the sense of the spin about +Z, which points at the viewer.
    fn deck(&self, view: &View) -> String {
        let (x, y) = view.middle;
        let radius = view.pixels_per_m * self.radius_m;
        let turn = 0.42 * radius;
        let (sine, cosine) = 60f64.to_radians().sin_cos();
        let (from, to) = ((x + turn, y), (x + turn * cosine, y + turn * sine));
        format!(
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"url(#deck)\" stroke=\"#2b3440\" \
             stroke-width=\"1.4\"/><circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2.6\" fill=\"#0072b2\"/>\
             <path d=\"M{:.2},{:.2}A{turn:.2},{turn:.2} 0 1 0 {:.2},{:.2}\" stroke=\"#0072b2\" \
             stroke-width=\"1.6\" fill=\"none\"/>{}",
            from.0,
            from.1,
            to.0,
            to.1,
            arrow_head(to, (sine, -cosine))
        )
    }
}

impl Thruster {
    fn draw(&self, view: &View, cylinder: &Cylinder) -> String {
        let unit_px = view.pixels_per_m * cylinder.radius_m;
        let (x, y) = view.screen(self.position_m);
        let (right, up) = (dot(self.jet, view.right), dot(self.jet, view.up));
        let seen = right.hypot(up);
        let fill = "fill=\"#4a525c\" stroke=\"#2b3440\" stroke-width=\"0.8\"";
        let exit = EXIT_HALF_WIDTH * unit_px;
        if seen < 0.1 {
            let open = dot(self.jet, view.viewer) > 0.0;
            let throat = if open { THROAT_HALF_WIDTH * unit_px } else { 0.0 };
            return format!(
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{exit:.2}\" {fill}/>\
                 <circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{throat:.2}\" fill=\"#9cc7ea\"/>"
            );
        }
        let along = (right / seen, -up / seen);
        let at = |length: f64, half_width: f64| {
            let (length, width) = (length * seen * unit_px, half_width * unit_px);
            (x + length * along.0 - width * along.1, y + length * along.1 + width * along.0)
        };
        let flank = |from: (f64, f64), to: (f64, f64)| {
            [at(from.0, from.1), at(to.0, to.1), at(to.0, -to.1), at(from.0, -from.1)]
        };
        let exit = (NOZZLE, EXIT_HALF_WIDTH);
        let plume = points(&flank(exit, (NOZZLE + PLUME, PLUME_HALF_WIDTH)));
        let nozzle = points(&flank((0.0, THROAT_HALF_WIDTH), exit));
        format!(
            "<polygon points=\"{plume}\" fill=\"#56a5e0\" fill-opacity=\"0.3\"/>\
             <polygon points=\"{nozzle}\" {fill} stroke-linejoin=\"round\"/>"
        )
    }
}

/// A head at `tip` that points in a direction of the screen.
fn arrow_head(tip: (f64, f64), direction: (f64, f64)) -> String {
    let at = |back: f64, side: f64| {
        (tip.0 - back * direction.0 - side * direction.1, tip.1 - back * direction.1 + side * direction.0)
    };
    let corners = points(&[at(-5.0, 0.0), at(6.0, 4.5), at(6.0, -4.5)]);
    format!("<polygon points=\"{corners}\" fill=\"#0072b2\"/>")
}

fn points(corners: &[(f64, f64)]) -> String {
    corners.iter().fold(String::new(), |mut text, (x, y)| {
        let _ = write!(text, "{x:.2},{y:.2} ");
        text
    })
}

#[cfg(test)]
mod tests {
    //! Thrusters stand where the file has them, and only a whole file gives a picture.
    use super::*;

    fn thruster(position_m: [f64; 3], force_n: [f64; 3]) -> physics::spacecraft::Thruster {
        physics::spacecraft::Thruster {
            name: String::new(),
            position_body_m: position_m.into(),
            force_body_n: force_n.into(),
            torque_body_n_m: [0.0; 3].into(),
            flow_kg_s: 0.0,
            valve: Default::default(),
            scatter: 0.0,
            set: None,
            tank: 0,
            at_pressure_pa: None,
            plume_half_angle_rad: 0.0,
        }
    }

    /// The corners of the polygons of a fill, in order.
    fn polygons(svg: &str, fill: &str) -> Vec<Vec<(f64, f64)>> {
        let of_fill = svg.split("<polygon points=\"").skip(1).filter(|tag| tag.contains(fill));
        let number = |text: &str| text.parse::<f64>().unwrap();
        let pair = |text: &str| {
            let (x, y) = text.split_once(',').unwrap();
            (number(x), number(y))
        };
        of_fill.map(|tag| tag.split('"').next().unwrap().split_whitespace().map(pair).collect()).collect()
    }

    #[test]
    fn a_thruster_blows_against_its_force() {
        let svg = svg(&[0.2, -0.2].map(|z_m| thruster([0.5, 0.0, z_m], [-2.0, 0.0, 0.0]))).unwrap();
        let nozzles = polygons(&svg, "#4a525c");
        // Two from aside, one above the other; two along the axis, one behind the other.
        let [upper, lower, hidden, shown] = nozzles.as_slice() else { panic!("{} nozzles", nozzles.len()) };
        let throat =
            |nozzle: &[(f64, f64)]| ((nozzle[0].0 + nozzle[3].0) / 2.0, (nozzle[0].1 + nozzle[3].1) / 2.0);
        let exit =
            |nozzle: &[(f64, f64)]| ((nozzle[1].0 + nozzle[2].0) / 2.0, (nozzle[1].1 + nozzle[2].1) / 2.0);
        for nozzle in [upper, lower, hidden, shown] {
            assert!(
                exit(nozzle).0 > throat(nozzle).0 + 5.0 && (exit(nozzle).1 - throat(nozzle).1).abs() < 0.02
            );
        }
        // The cylinder's side is 0.4 m high, and 0.5 m lie between its axis and the throats.
        let pixels_per_m = (throat(upper).0 - WIDTH / 4.0) / 0.5;
        assert!((throat(lower).1 - throat(upper).1 - 0.4 * pixels_per_m).abs() < 0.05);
        assert!((throat(shown).0 - WIDTH * 0.75 - 0.5 * pixels_per_m).abs() < 0.05);
        assert_eq!(hidden, shown);
        for (x, y) in nozzles.iter().flatten().chain(polygons(&svg, "#56a5e0").iter().flatten()) {
            assert!((0.0..WIDTH).contains(x) && (0.0..HEIGHT).contains(y), "{x},{y} is outside the picture");
        }
    }

    #[test]
    fn anything_else_gives_no_picture() {
        let good = thruster([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        for thrusters in [
            vec![],
            vec![thruster([0.0, 0.0, 1.0], [1.0, 0.0, 0.0])],
            vec![thruster([1.0, 0.0, f64::NAN], [1.0, 0.0, 0.0])],
            vec![good, thruster([1.0, 0.0, 0.0], [0.0; 3])],
        ] {
            assert!(svg(&thrusters).is_none(), "{thrusters:?}");
        }
    }
}
