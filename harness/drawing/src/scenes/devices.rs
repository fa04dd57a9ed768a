//! Devices of a spacecraft in a picture: thrusters, wheels, tanks, instruments, antennas, Sun sensors.

use physics::spacecraft::{AntennaRange, MountedSunSensor, Spacecraft};

use super::parts::{ANTENNA, Arrow, BORESIGHT, Part, SUN_SENSOR, WHEEL, box_of, called, nozzle};
use crate::{Finish, Surface, Vector, unit};

/// Thrusters, wheels, tanks, instruments, antennas and Sun sensors.
#[derive(Default)]
pub(super) struct Devices {
    pub(super) parts: Vec<Part>,
    pub(super) nozzles: Vec<Surface>,
    pub(super) arrows: Vec<Arrow>,
    pub(super) remarks: Vec<&'static str>,
}

impl Devices {
    /// Devices of a spacecraft with these surfaces; the first is part `first`.
    pub(super) fn from_spacecraft(spacecraft: &Spacecraft, surfaces: &[Surface], first: usize) -> Self {
        let mut devices = Self::default();
        let Some([low_m, high_m]) = box_of(surfaces.iter()) else { return devices };
        let size_m = (high_m - low_m).max();
        let greatest_n = spacecraft.thrusters.iter().map(|it| it.force_body_n.norm()).fold(0.0, f64::max);
        for (index, thruster) in spacecraft.thrusters.iter().enumerate() {
            let force_n = thruster.force_body_n.norm();
            let Some(jet) = unit(-thruster.force_body_n) else { continue };
            // A weak one is smaller, and still to be seen.
            let length_m = 0.05 * size_m * (force_n / greatest_n).powf(0.2);
            let part = first + devices.parts.len();
            devices.nozzles.extend(nozzle(thruster.position_body_m, jet, length_m, part));
            let what = format!("{} N", terminal::short(force_n));
            let mut part = Part::new(format!("T{}", index + 1), &thruster.name, what);
            part.beside_m = Some(thruster.position_body_m + 1.5 * length_m * jet);
            devices.parts.push(part);
        }
        for (index, wheel) in spacecraft.wheels.iter().enumerate() {
            let what = format!("{} N m s", terminal::short(wheel.capacity_n_m_s));
            let part = Part::new(format!("W{}", index + 1), &called("wheel", &wheel.name), what);
            devices.arrow(part, wheel.position_body_m, wheel.axis_body, 0.1 * size_m, WHEEL);
        }
        for (index, tank) in spacecraft.tanks.iter().enumerate() {
            let what = format!("{} kg", terminal::short(tank.propellant_kg));
            let mut part = Part::new(format!("K{}", index + 1), &called("tank", &tank.name), what);
            (part.beside_m, part.is_inside) = (Some(tank.position_body_m), true);
            devices.parts.push(part);
        }
        // The file gives no place: out of the body, seen from the centre of mass, panels left out where there is something else.
        let body = surfaces.iter().filter(|surface| surface.finish != Finish::Cells);
        let bounds_m = box_of(body).unwrap_or([low_m, high_m]);
        let center_m = spacecraft.mass_properties.center_of_mass_body_m;
        devices.add_directed(spacecraft, size_m, |direction| leaves(bounds_m, center_m, direction));
        devices.add_remarks(spacecraft);
        devices
    }

    /// Instruments, antennas and Sun sensors, whose lines begin where `from_m` says.
    fn add_directed(&mut self, spacecraft: &Spacecraft, size_m: f64, from_m: impl Fn(&Vector) -> Vector) {
        for (index, instrument) in spacecraft.instruments.iter().enumerate() {
            let part = Part::new(format!("I{}", index + 1), &instrument.name, "instrument".to_owned());
            let boresight = instrument.boresight_body;
            self.arrow(part, from_m(&boresight), boresight, 0.12 * size_m, BORESIGHT);
        }
        for (index, named) in spacecraft.antennas.iter().enumerate() {
            let sign = format!("A{}", index + 1);
            let length_m = 0.12 * size_m;
            let (middle, ends, what) = match &named.antenna.range {
                AntennaRange::Axis(axis_body) => (*axis_body, vec![*axis_body], "antenna".to_owned()),
                AntennaRange::Fan(fan) => {
                    let ends_rad = fan.bounds_rad();
                    let [from_deg, to_deg] =
                        ends_rad.map(|end_rad| terminal::short(end_rad.to_degrees().round()));
                    let toward = |azimuth_rad: f64| Vector::new(azimuth_rad.sin(), -azimuth_rad.cos(), 0.0);
                    let what = format!("antenna, azimuth {from_deg} to {to_deg} deg");
                    (toward(fan.middle_rad), ends_rad.map(toward).to_vec(), what)
                }
            };
            let start_m = from_m(&middle);
            let arrow =
                |end: &Vector| Arrow { from_m: start_m, to_m: start_m + length_m * end, colour: ANTENNA };
            self.arrows.extend(ends.iter().map(arrow));
            let mut part = Part::new(sign, &called("antenna", &named.name), what);
            part.beside_m = Some(start_m + 1.25 * length_m * middle);
            self.parts.push(part);
        }
        for (index, sensor) in given_sun_sensors(spacecraft).iter().enumerate() {
            let half_deg = terminal::short(sensor.half_field_of_view_rad.to_degrees());
            let what = format!("Sun sensor, {half_deg} deg to each side");
            let part = Part::new(format!("S{}", index + 1), &sensor.name, what);
            self.arrow(part, from_m(&sensor.axis_body), sensor.axis_body, 0.08 * size_m, SUN_SENSOR);
        }
    }

    fn add_remarks(&mut self, spacecraft: &Spacecraft) {
        let remarks = [
            (spacecraft.wheels.is_empty(), "Green arrows are axes of wheels, as they turn right-handed."),
            (spacecraft.tanks.is_empty(), "Circles are tanks."),
            (spacecraft.instruments.is_empty(), "Blue arrows are boresights of instruments."),
            (
                spacecraft.antennas.is_empty(),
                "Magenta arrows are where antennas look: fans from the one to the other.",
            ),
            (given_sun_sensors(spacecraft).is_empty(), "Brown arrows are axes of Sun sensors."),
            (spacecraft.thrusters.is_empty(), "Nozzles point where the jet goes."),
        ];
        self.remarks.extend(remarks.into_iter().filter(|(is_absent, _)| !is_absent).map(|(_, it)| it));
    }

    fn arrow(
        &mut self,
        mut part: Part,
        from_m: Vector,
        direction: Vector,
        length_m: f64,
        colour: &'static str,
    ) {
        let to_m = from_m + length_m * direction;
        self.arrows.push(Arrow { from_m, to_m, colour });
        part.beside_m = Some(to_m + 0.25 * length_m * direction);
        part.is_inside = colour == WHEEL;
        self.parts.push(part);
    }
}

/// Sun sensors of the file: six along the body axes are assumed where it says nothing.
fn given_sun_sensors(spacecraft: &Spacecraft) -> &[MountedSunSensor] {
    if spacecraft.sun_sensors == MountedSunSensor::six() { &[] } else { &spacecraft.sun_sensors }
}

/// Point at which a line from a centre leaves a box.
fn leaves([low_m, high_m]: [Vector; 2], center_m: Vector, direction: &Vector) -> Vector {
    let side_m = |i: usize| if direction[i] < 0.0 { low_m[i] } else { high_m[i] };
    let along = (0..3).filter(|i| direction[*i] != 0.0);
    let along = along.map(|i| (side_m(i) - center_m[i]).abs() / direction[i].abs());
    center_m + along.fold(f64::INFINITY, f64::min) * direction
}
