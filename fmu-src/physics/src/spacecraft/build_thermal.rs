//! From the file's shape to outlines and heat: surfaces of the spacecraft.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::checker::Checker;
use super::describe_thermal::{ConductionDescription, SurroundingsDescription, ThermalDescription};
use super::description::OpticsDescription;
use super::optics::Optics;
use super::place::Place;
use super::polygon::Polygon;
use super::spelling::nearest;
use super::thermal::{
    BACKGROUND_K, BusLink, Conduction, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal,
    HIGHEST_TEMPERATURE_K, Honeycomb, Thermal,
};

/// How far area, centre and normal may be off the polygon's, relative to its size: printed tables are rounded ...
const OUTLINE_TOLERANCE: f64 = 1e-3;

/// ... and corners stand in whole millimetres, ...
const ROUNDING_M: f64 = 1e-3;

/// ... which on the smallest polygons is no excuse for more than this.
const GREATEST_TOLERANCE: f64 = 0.02;

/// What a file says of a material.
#[derive(Clone, Copy)]
pub(super) struct Material {
    pub optics: Optics,
    pub thermal: FaceThermal,
}

impl Material {
    /// Stands in for a material that was reported as unknown.
    pub const BLACK: Self = Self {
        optics: Optics::from_reflectivities(0.0, 0.0),
        thermal: FaceThermal::like_sunlight(&Optics::from_reflectivities(0.0, 0.0)),
    };
}

/// What every surface exchanges heat with.
#[derive(Clone, Copy)]
pub(super) struct Surroundings {
    pub background_k: f64,
    /// Of the bus, if the file gives one for all surfaces.
    pub bus_temperature_k: Option<f64>,
}

impl Surroundings {
    pub fn of(check: &mut Checker<'_>, description: Option<&SurroundingsDescription>) -> Self {
        let at = Place::root().key("thermal");
        let mut kelvin = |key: &str, value: f64| {
            check.within(&at.key(key), value, 0.0, HIGHEST_TEMPERATURE_K, "0 to 2000 K")
        };
        let given = |of: fn(&SurroundingsDescription) -> Option<f64>| description.and_then(of);
        Self {
            background_k: given(|it| it.background_k).map_or(BACKGROUND_K, |it| kelvin("background_k", it)),
            bus_temperature_k: given(|it| it.bus_temperature_k).map(|it| kelvin("bus_temperature_k", it)),
        }
    }
}

/// The file's materials by name, and what their surfaces exchange heat with.
pub(super) struct Materials {
    by_name: BTreeMap<String, Material>,
    pub surroundings: Surroundings,
}

impl Materials {
    /// None yet.
    pub fn new(surroundings: Surroundings) -> Self {
        Self { by_name: BTreeMap::new(), surroundings }
    }

    pub fn insert(&mut self, name: &str, material: Material) {
        self.by_name.insert(name.to_owned(), material);
    }

    /// The material of this name; an unknown one is reported.
    pub fn find(&self, check: &mut Checker<'_>, at: &Place, name: &str) -> Material {
        if let Some(material) = self.by_name.get(name) {
            return *material;
        }
        if check.is_stand_in(&Place::root().key("optics")) {
            return Material::BLACK;
        }
        let known: Vec<&str> = self.by_name.keys().map(String::as_str).collect();
        let hint = nearest(name, &known).map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default();
        let allowed = format!("a material under [optics]: {}", known.join(", "));
        check.report(at, format_args!("the unknown material `{name}`{hint}"), allowed);
        Material::BLACK
    }
}

pub(super) fn face_thermal(
    check: &mut Checker<'_>,
    at: &Place,
    description: &OpticsDescription,
    sunlight: &Optics,
) -> FaceThermal {
    let infrared_optics = description.infrared_absorptivity.map_or(*sunlight, |absorptivity| {
        sunlight.with_absorptivity(check.fraction(&at.key("infrared_absorptivity"), absorptivity))
    });
    let like_sunlight = FaceThermal::like_sunlight(sunlight).emission.emissivity;
    let emissivity = description.emissivity.map_or(like_sunlight, |emissivity| {
        check.within(&at.key("emissivity"), emissivity, 1e-3, 1.0, "a number from 0.001 to 1")
    });
    let slope = at.key("emissivity_per_k");
    let emission = Emission {
        emissivity,
        slope_per_k: check.finite(&slope, description.emissivity_per_k.unwrap_or(0.0)),
        reference_temperature_k: check.within(
            &at.key("emissivity_temperature_k"),
            description.emissivity_temperature_k.unwrap_or(EMISSIVITY_REFERENCE_TEMPERATURE_K),
            0.0,
            HIGHEST_TEMPERATURE_K,
            "0 to 2000 K",
        ),
    };
    if !emission.grows() {
        check.report_across(
            at,
            &slope,
            emission.slope_per_k,
            "a slope so small that up to 2000 K a hotter face emits more power",
        );
    }
    FaceThermal { infrared_optics, emission }
}

pub(super) fn thermal(
    check: &mut Checker<'_>,
    surroundings: Surroundings,
    at: &Place,
    description: Option<&ThermalDescription>,
    front: Material,
    rear: Option<Material>,
) -> Thermal {
    let nothing = ThermalDescription::default();
    let (surface, at) = (at, at.key("thermal"));
    let description = description.unwrap_or(&nothing);
    if rear.is_none() && !check.is_stand_in(&surface.key("rear_optics")) {
        let needs_rear = [
            ("conduction", description.conduction.is_some()),
            ("rear_internal_heat_w", description.rear_internal_heat_w.is_some()),
            ("rear_bus_conductance_w_m2_k", description.rear_bus_conductance_w_m2_k.is_some()),
        ];
        for (key, _) in needs_rear.into_iter().filter(|(_, given)| *given) {
            check.report(&at.key(key), "a surface without `rear_optics`", "a surface with both faces");
        }
    }
    let bus = bus(check, surroundings, &at, description);
    let mut heat = |key: &str, value: Option<f64>| {
        let value = value.unwrap_or(0.0);
        check.not_negative(&at.key(key), value)
    };
    Thermal {
        front: front.thermal,
        rear: rear.map(|rear| rear.thermal),
        bus,
        internal_heat_w: [
            heat("internal_heat_w", description.internal_heat_w),
            heat("rear_internal_heat_w", description.rear_internal_heat_w),
        ],
        heat_capacity_j_m2_k: heat("heat_capacity_j_m2_k", description.heat_capacity_j_m2_k),
        conduction: description.conduction.as_ref().map(|c| conduction(check, &at.key("conduction"), c)),
    }
}

/// Heat flow from front and rear to the bus.
fn bus(
    check: &mut Checker<'_>,
    surroundings: Surroundings,
    at: &Place,
    description: &ThermalDescription,
) -> [BusLink; 2] {
    let temperature = at.key("bus_temperature_k");
    let own_k = description
        .bus_temperature_k
        .map(|own_k| check.within(&temperature, own_k, 0.0, HIGHEST_TEMPERATURE_K, "0 to 2000 K"));
    let faces = [
        ("bus_conductance_w_m2_k", description.bus_conductance_w_m2_k),
        ("rear_bus_conductance_w_m2_k", description.rear_bus_conductance_w_m2_k),
    ];
    if own_k.is_some() && faces.iter().all(|(_, given)| given.is_none()) {
        check.report(&temperature, "no conductance to the bus", "`bus_conductance_w_m2_k` beside it");
    }
    faces.map(|(key, given)| {
        let Some(conductance_w_m2_k) = given else { return BusLink::NONE };
        let place = at.key(key);
        let conductance_w_m2_k = check.not_negative(&place, conductance_w_m2_k);
        let temperature_k = own_k.or(surroundings.bus_temperature_k);
        if temperature_k.is_none() && conductance_w_m2_k > 0.0 {
            check.report(
                &place,
                "no temperature of the bus",
                "`bus_temperature_k` beside it or under [thermal]",
            );
        }
        BusLink { conductance_w_m2_k, temperature_k: temperature_k.unwrap_or(0.0) }
    })
}

fn conduction(check: &mut Checker<'_>, at: &Place, description: &ConductionDescription) -> Conduction {
    let conductance = at.key("conductance_w_m2_k");
    let Some(honeycomb) = &description.honeycomb else {
        if (description.conductance_w_m2_k, description.radiative_exchange) == (None, None) {
            check.report(
                at,
                "no conduction",
                "`honeycomb`, or `conductance_w_m2_k` and `radiative_exchange` or one of them",
            );
        }
        let q = description.conductance_w_m2_k.unwrap_or(0.0);
        let exchange = description.radiative_exchange.unwrap_or(0.0);
        return Conduction {
            conductance_w_m2_k: check.not_negative(&conductance, q),
            radiative_exchange: check.fraction(&at.key("radiative_exchange"), exchange),
        };
    };
    if (description.conductance_w_m2_k, description.radiative_exchange) != (None, None) {
        check.report(at, "both numbers and a `honeycomb`", "one of them");
    }
    let place = at.key("honeycomb");
    Honeycomb {
        conductivity_w_m_k: check.positive(&place.key("conductivity_w_m_k"), honeycomb.conductivity_w_m_k),
        thickness_m: check.positive(&place.key("thickness_m"), honeycomb.thickness_m),
        wall_area_ratio: check.fraction(&place.key("wall_area_ratio"), honeycomb.wall_area_ratio),
        packing_factor: check.fraction(&place.key("packing_factor"), honeycomb.packing_factor),
        internal_emissivity: check.fraction(&place.key("internal_emissivity"), honeycomb.internal_emissivity),
    }
    .conduction()
}

/// How far a value may be off what the outline gives, relative to its size.
fn tolerance(outline: &Polygon) -> f64 {
    (ROUNDING_M / outline.area_m2().sqrt()).clamp(OUTLINE_TOLERANCE, GREATEST_TOLERANCE)
}

fn short(tolerance: f64) -> String {
    if tolerance > OUTLINE_TOLERANCE { format!("{tolerance:.1e}") } else { "1e-3".to_owned() }
}

/// The outline with its front where the normal is, if both are given.
pub(super) fn checked_outline(
    check: &mut Checker<'_>,
    at: &Place,
    vertices_m: Option<&[[f64; 3]]>,
    normal: Option<&Vector3<f64>>,
) -> Option<Polygon> {
    let place = at.key("polygon_m");
    let vertices_m = vertices_m?;
    for (i, vertex) in vertices_m.iter().enumerate() {
        check.vector(&place.item(i), *vertex);
    }
    match Polygon::new(vertices_m.iter().map(|v| Vector3::from(*v)).collect()) {
        Ok(polygon) => {
            let along = normal.map_or(1.0, |normal| polygon.normal().dot(normal));
            let off = tolerance(&polygon);
            if let (Some(normal), true) = (normal, along.abs() < (1.0 - off.powi(2) / 2.0)) {
                check.report_across(
                    at,
                    &place,
                    format_args!("an outline with the normal {:?}", polygon.normal().as_slice()),
                    format_args!(
                        "one with the normal {:?} or its opposite, within {}",
                        normal.as_slice(),
                        short(off)
                    ),
                );
            }
            Some(if along < 0.0 { polygon.reversed() } else { polygon })
        }
        Err(error) => {
            let text = error.to_string();
            let (found, allowed) = text.split_once(", allowed: ").unwrap_or((&text, "a polygon"));
            check.report(&place, found, allowed);
            None
        }
    }
}

pub(super) fn checked_area(
    check: &mut Checker<'_>,
    at: &Place,
    given_m2: Option<f64>,
    outline: Option<&Polygon>,
) -> f64 {
    let place = at.key("area_m2");
    let given_m2 = given_m2.map(|area_m2| check.positive(&place, area_m2));
    match (given_m2, outline) {
        (Some(area_m2), None) => area_m2,
        (None, None) => missing(check, at, "area_m2", 1.0),
        (given_m2, Some(outline)) => {
            let area_m2 = outline.area_m2();
            if let Some(given_m2) = given_m2
                && (given_m2 / area_m2 - 1.0).abs() > tolerance(outline)
            {
                let allowed = format!("the polygon's {area_m2} within {}", short(tolerance(outline)));
                check.report_across(at, &place, given_m2, allowed);
            }
            area_m2
        }
    }
}

pub(super) fn checked_center(
    check: &mut Checker<'_>,
    at: &Place,
    given_m: Option<[f64; 3]>,
    outline: Option<&Polygon>,
) -> Vector3<f64> {
    let place = at.key("center_m");
    let given_m = given_m.map(|center_m| check.vector(&place, center_m));
    match (given_m, outline) {
        (Some(center_m), None) => center_m,
        (None, None) => missing(check, at, "center_m", Vector3::zeros()),
        (given_m, Some(outline)) => {
            let center_m = outline.centroid_m();
            if let Some(given_m) = given_m
                && (given_m - center_m).norm() > tolerance(outline) * outline.area_m2().sqrt()
            {
                let found = format!("{:?}", given_m.as_slice());
                let allowed = format!(
                    "the polygon's {:?} within {} of its size",
                    center_m.as_slice(),
                    short(tolerance(outline))
                );
                check.report_across(at, &place, found, allowed);
            }
            center_m
        }
    }
}

pub(super) fn checked_normal(
    check: &mut Checker<'_>,
    at: &Place,
    given: Option<Vector3<f64>>,
    outline: Option<&Polygon>,
) -> Vector3<f64> {
    match (given, outline) {
        (_, Some(outline)) => outline.normal(),
        (Some(normal), None) => normal,
        (None, None) => missing(check, at, "normal", Vector3::x()),
    }
}

fn missing<V>(check: &mut Checker<'_>, at: &Place, key: &str, stand_in: V) -> V {
    // An outline that was refused would have given it.
    let outline = at.key("polygon_m");
    if check.has_reported(&outline) || check.is_stand_in(&outline) {
        return stand_in;
    }
    check.report_lack(at, key, format_args!("a value for `{key}`, or an outline `polygon_m`"));
    stand_in
}
