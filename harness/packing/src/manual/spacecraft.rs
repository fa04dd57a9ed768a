//! Contents of the packed spacecraft: surfaces, panels, wheels, thrusters by name.

use model_description::escape;
use nalgebra::Vector3;
use physics::{
    spacecraft::{Spacecraft, Sunshade, SunshadeModel, Thruster},
    spin::spinner::Spinner,
};

use super::section::{Section, table};

/// The section with its picture; none for a setup that is no spacecraft.
pub(super) fn section(setup: &str, drawing: Option<&str>) -> Option<Section> {
    let tables = match Spacecraft::from_toml("", setup) {
        Ok(spacecraft) => of_spacecraft(&spacecraft),
        Err(_) => of_spinner(&Spinner::parse("", setup).ok()?),
    };
    let picture = drawing.map_or(String::new(), |svg| format!("<figure>{svg}</figure>\n"));
    Some(("spacecraft", "Spacecraft", picture + &tables))
}

/// Without the noise of rounding, which millionths of a metre or a kilogramme do not show.
fn number(value: f64) -> String {
    terminal::short((value * 1e6).round() / 1e6 + 0.0)
}

fn vector(value: &Vector3<f64>) -> String {
    let [x, y, z]: [f64; 3] = (*value).into();
    format!("({}, {}, {})", number(x), number(y), number(z))
}

fn row(name: &str, cells: &[String]) -> String {
    let cells: String = cells.iter().map(|cell| format!("<td class=\"v\">{cell}</td>")).collect();
    format!("<tr><td class=\"n\">{}</td>{cells}</tr>\n", escape(name))
}

/// A table under a heading; nothing without rows.
fn part(heading: &str, header: &[&str], rows: Vec<String>) -> String {
    if rows.is_empty() { String::new() } else { format!("<h3>{heading}</h3>\n{}", table(header, rows)) }
}

fn of_spacecraft(spacecraft: &Spacecraft) -> String {
    let mass = &spacecraft.mass_properties;
    let inertia = mass.inertia_body_kg_m2.diagonal();
    let mut text = format!(
        "<p>{}: {} kg, centre of mass {} m, moments of inertia {} kg&middot;m&sup2;.</p>\n",
        escape(&spacecraft.name),
        number(mass.mass_kg),
        vector(&mass.center_of_mass_body_m),
        vector(&inertia)
    );
    let surface = ["Name", "Area [m&sup2;]", "Centre [m]", "Normal"];
    let of_plate = |plate: &physics::spacecraft::Plate| {
        row(&plate.name, &[number(plate.area_m2), vector(&plate.center_m), vector(&plate.normal)])
    };
    text += &part("Plates", &surface, spacecraft.plates.iter().map(of_plate).collect());
    if let Some(shade) = &spacecraft.sunshade {
        text += &sunshade(shade, shade.plates.iter().map(of_plate).collect(), &surface);
    }
    let panels = spacecraft.panels.iter().enumerate().map(|(k, panel)| {
        let cells = [
            number(panel.area_m2),
            vector(&panel.center_body_m),
            vector(&panel.axis_body),
            format!("<code>panel[{}]</code>", k + 1),
        ];
        row(&panel.name, &cells)
    });
    let header = ["Name", "Area of one side [m&sup2;]", "Centre [m]", "Axis", "Variables"];
    text += &part("Panels", &header, panels.collect());
    let wheels = spacecraft.wheels.iter().enumerate().map(|(k, wheel)| {
        let cells = [
            vector(&wheel.axis_body),
            number(wheel.capacity_n_m_s),
            number(wheel.max_torque_n_m),
            format!("<code>wheel[{}]</code>", k + 1),
        ];
        row(&wheel.name, &cells)
    });
    let header = ["Name", "Axis", "Capacity [N&middot;m&middot;s]", "Torque [N&middot;m]", "Variables"];
    text += &part("Wheels", &header, wheels.collect());
    text += &thrusters(&spacecraft.thrusters);
    let tanks = spacecraft
        .tanks
        .iter()
        .map(|tank| row(&tank.name, &[number(tank.propellant_kg), vector(&tank.position_body_m)]));
    text += &part("Tanks", &["Name", "Propellant [kg]", "Position [m]"], tanks.collect());
    let instruments = spacecraft.instruments.iter().enumerate().map(|(k, instrument)| {
        row(&instrument.name, &[vector(&instrument.boresight_body), (k + 1).to_string()])
    });
    text += &part("Instruments", &["Name", "Boresight", "Number"], instruments.collect());
    let antennas = spacecraft.antennas.iter().enumerate().map(|(k, named)| {
        let beam_rad = [named.antenna.across_rad, named.antenna.along_rad];
        let [across_deg, along_deg] = beam_rad.map(|width_rad| number(width_rad.to_degrees()));
        row(
            &named.name,
            &[named.antenna.range.to_string(), format!("{across_deg} x {along_deg}"), (k + 1).to_string()],
        )
    });
    let header = ["Name", "Looks", "Beam across and along XY [deg]", "Number"];
    text + &part("Antennas", &header, antennas.collect())
}

fn sunshade(shade: &Sunshade, plates: Vec<String>, surface: &[&str]) -> String {
    let used = match shade.model {
        SunshadeModel::Plates => "plates",
        SunshadeModel::Cylinder => "a cylinder",
    };
    let described = match (&shade.cylinder, plates.is_empty()) {
        (Some(_), false) => "plates and a cylinder",
        (Some(_), true) => "a cylinder",
        (None, _) => "plates",
    };
    let table = if plates.is_empty() { String::new() } else { table(surface, plates) };
    format!("<h3>Sunshade</h3>\n<p>Described as {described}; the file uses {used}.</p>\n{table}")
}

fn thrusters(thrusters: &[Thruster]) -> String {
    let rows = thrusters.iter().enumerate().map(|(k, thruster)| {
        let cells = [
            number(thruster.force_body_n.norm()),
            vector(&thruster.force_body_n.normalize()),
            vector(&thruster.position_body_m),
            format!("<code>thruster[{}]</code>", k + 1),
        ];
        row(&thruster.name, &cells)
    });
    part(
        "Thrusters",
        &["Name", "Thrust [N]", "Direction of force", "Position [m]", "Variables"],
        rows.collect(),
    )
}

fn of_spinner(spinner: &Spinner) -> String {
    format!("<p>{}, spinning about +Z.</p>\n{}", escape(&spinner.name), thrusters(&spinner.thrusters))
}
