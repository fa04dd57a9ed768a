//! NAIF ids of bodies and spacecraft, and their names.

use anise::constants::celestial_objects::celestial_name_from_id;
use physics::{bodies::Body, environment::onboard::OnboardTarget};

/// MESSENGER.
pub(super) const MESSENGER: i32 = -236;

/// The Moon.
pub(super) const MOON: i32 = 301;

/// The id of a body itself, not of the barycentre of its system.
pub(super) const fn id(body: Body) -> i32 {
    match body {
        Body::Sun => 10,
        Body::Mercury => 199,
        Body::Venus => 299,
        Body::Earth => 399,
        Body::Mars => 499,
        Body::Jupiter => 599,
        // Its own id is the centre's: the Solar System barycentre stands for none.
        Body::Custom => 0,
    }
}

/// A name with its id, for messages.
pub(super) fn named(id: i32) -> String {
    match celestial_name_from_id(id) {
        Some(name) => format!("{name} ({id})"),
        None if id == MESSENGER => format!("MESSENGER ({id})"),
        None if id < 0 => format!("spacecraft {id}"),
        None => format!("body {id}"),
    }
}

/// A body from where positions count, and the id that stands for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Center {
    /// The body.
    pub body: Body,
    /// Its id, or that of the barycentre of its system.
    pub id: i32,
}

/// A centre by name or id; another body than the known ones is `custom`, that of the spacecraft's file. The barycentre stands for a planet, as kernels
/// often place nothing else, but never for the Earth, which the Moon carries 4700 km away from it.
pub fn center(text: &str) -> Result<Center, String> {
    let text = text.trim().to_lowercase();
    Body::ALL
        .into_iter()
        .find_map(|body| {
            let id = id(body);
            let barycentre = (!matches!(body, Body::Sun | Body::Earth)).then_some(id / 100);
            if OnboardTarget::from(body).to_string() == text {
                return Some(Center { body, id });
            }
            let given = text.parse().ok()?;
            (given == id || Some(given) == barycentre).then_some(Center { body, id: given })
        })
        .or_else(|| {
            // Ids of moons, asteroids and comets; those below are barycentres.
            let id = text.parse().ok().filter(|id| *id > 10)?;
            Some(Center { body: Body::Custom, id })
        })
        .ok_or_else(|| {
            let names: Vec<String> = Body::ALL.map(|body| OnboardTarget::from(body).to_string()).into();
            format!(
                "allowed is one of {}, or its NAIF id, or that of another body, which is `custom` then",
                names.join(", ")
            )
        })
}

/// A spacecraft by name or id.
pub fn spacecraft(text: &str) -> Result<i32, String> {
    let text = text.trim();
    if text.eq_ignore_ascii_case("messenger") {
        return Ok(MESSENGER);
    }
    match text.parse::<i32>() {
        Ok(id) if id < 0 => Ok(id),
        _ => Err(format!("allowed is messenger ({MESSENGER}) or a NAIF id below 0")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_go_by_names_and_ids() {
        for (text, body, id) in [
            ("mercury", Body::Mercury, 199),
            ("Mercury", Body::Mercury, 199),
            ("1", Body::Mercury, 1),
            ("10", Body::Sun, 10),
            ("399", Body::Earth, 399),
            ("4", Body::Mars, 4),
            ("599", Body::Jupiter, 599),
            // Saturn and the Moon, which no table has: the file's own.
            ("699", Body::Custom, 699),
            ("301", Body::Custom, 301),
        ] {
            assert_eq!(center(text), Ok(Center { body, id }), "{text}");
        }
        // Earth-Moon and solar system barycentres, no body.
        for text in ["3", "0", "saturn", "", "-236"] {
            assert!(center(text).is_err(), "{text}");
        }
        assert_eq!(spacecraft("MESSENGER"), Ok(-236));
        assert_eq!(spacecraft("-121"), Ok(-121));
        for text in ["10", "0", "ship", ""] {
            assert!(spacecraft(text).is_err(), "{text}");
        }
        assert_eq!(named(199), "Mercury (199)");
        assert_eq!(named(-234), "spacecraft -234");
    }
}
