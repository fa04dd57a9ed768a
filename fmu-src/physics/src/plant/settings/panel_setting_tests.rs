//! Steps hold from their time on; every law's rate is that of its differences.

use approx::assert_relative_eq;

use super::*;
use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::spacecraft::{MESSENGER_TOML, Spacecraft};

const AU_M: f64 = ASTRONOMICAL_UNIT_M;

fn panel() -> Panel {
    Spacecraft::from_toml("", MESSENGER_TOML).unwrap().panels.swap_remove(0)
}

fn steps(of: &[(f64, f64)]) -> Arc<[PanelStep]> {
    of.iter().map(|&(at_s, offset_rad)| PanelStep { at_s, offset_rad }).collect()
}

/// The Sun as a spacecraft meets it that turns and approaches it.
fn sun_at(time_s: f64) -> SunAt {
    let turn = 0.3 + 2e-4 * time_s;
    let direction_body = Vector3::new(0.1, -turn.cos(), turn.sin()).normalize();
    SunAt { time_s, direction_body, distance_m: 0.35 * AU_M - 4e4 * time_s }
}

fn timeline(of: &[(f64, f64)]) -> PanelSetting {
    PanelSetting::Timeline { steps: steps(of), clock_minus_time_s: 0.0, before_rad: 1.1, tilt: (-1.0).into() }
}

#[test]
fn a_step_holds_from_its_time_on() {
    let setting = timeline(&[(-5.0, 0.2), (60.0, -0.7), (90.0, 0.4)]);
    let ahead = |time_s: f64| SunAt { direction_body: -Vector3::y(), ..sun_at(time_s) };
    for (time_s, offset_rad, until_s) in [
        ((-5.0_f64).next_down(), 1.1, -5.0),
        (-5.0, 0.2, 60.0),
        (60.0_f64.next_down(), 0.2, 60.0),
        (60.0, -0.7, 90.0),
        (90.0, 0.4, f64::INFINITY),
        (1e9, 0.4, f64::INFINITY),
    ] {
        assert_relative_eq!(
            setting.angle_rad(&panel(), &ahead(time_s)).unwrap(),
            -offset_rad,
            epsilon = 1e-15
        );
        assert_eq!(setting.until_s(time_s), until_s, "{time_s}");
    }
    let empty = timeline(&[]);
    assert_relative_eq!(empty.angle_rad(&panel(), &ahead(3.0)).unwrap(), -1.1, epsilon = 1e-15);
    assert_eq!(empty.until_s(3.0), f64::INFINITY);
}

#[test]
fn the_rate_of_every_law_is_that_of_its_differences() {
    const H_S: f64 = 1e-2;
    let ramp = Ramp::since(10.0, 0.4, -3e-4);
    let [before, after] = [-1.0, 1.0].map(|step| sun_at(50.0 + step * H_S));
    let now = sun_at(50.0);
    let rate = (after.direction_body - before.direction_body) / (2.0 * H_S);
    let moving = SunAt {
        time_s: Dual64::new(50.0, 1.0),
        direction_body: now.direction_body.zip_map(&rate, Dual64::new),
        distance_m: Dual64::new(now.distance_m, -4e4),
    };
    for setting in [
        PanelSetting::Angle(ramp),
        PanelSetting::SunOffset { offset: ramp, tilt: (-1.0).into() },
        timeline(&[(0.0, -0.6)]),
        PanelSetting::Distance { suns: 3.0, tilt: 1.0.into() },
        PanelSetting::Distance { suns: 90.0, tilt: 1.0.into() },
    ] {
        let angle = |sun: &SunAt| setting.angle_rad(&panel(), sun).unwrap();
        let [angle_rad, rate_rad_s] = setting.turn_rad(&panel(), &moving);
        assert_eq!(angle_rad, angle(&now), "{setting:?}");
        assert_relative_eq!(rate_rad_s, (angle(&after) - angle(&before)) / (2.0 * H_S), max_relative = 1e-6);
    }
    assert_eq!(PanelSetting::Disabled.turn_rad(&panel(), &moving), [0.0; 2]);
}

/// By rotating the cell normal about the axis.
#[test]
fn a_bias_turns_the_panel_about_its_axis_under_every_law() {
    let (panel, sun) = (panel(), sun_at(50.0));
    let axis = nalgebra::Unit::new_normalize(panel.axis_body);
    for setting in [
        PanelSetting::Angle(Ramp::since(10.0, 0.4, -3e-4)),
        PanelSetting::SunOffset { offset: Ramp::held(0.5), tilt: (-1.0).into() },
        timeline(&[(0.0, -0.6)]),
        PanelSetting::Distance { suns: 3.0, tilt: 1.0.into() },
    ] {
        assert_eq!(setting.clone().biased(0.0), setting);
        let biased = setting.clone().biased(0.3);
        let [own_rad, angle_rad] = [&setting, &biased].map(|it| it.angle_rad(&panel, &sun).unwrap());
        assert_relative_eq!(angle_rad, own_rad + 0.3, epsilon = 1e-15);
        let [own, normal] = [&setting, &biased].map(|it| it.normal_body(&panel, &sun).unwrap());
        let turned = nalgebra::Rotation3::from_axis_angle(&axis, 0.3) * own;
        assert_relative_eq!(normal, turned, epsilon = 1e-15);
    }
    assert_eq!(PanelSetting::Disabled.biased(0.3), PanelSetting::Disabled);
}
