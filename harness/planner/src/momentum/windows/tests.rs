//! Windows cover the flight once; alternation has its share and no contact.

use super::*;
use crate::momentum::test_spacecraft::{DAY_S, simulated, sunlit, task};

const REACH: ControlBounds = ControlBounds {
    offset_rad: 0.0,
    windmill_rad: 0.03,
    azimuth_rad: 0.1,
    elevation_rad: 0.1,
    alternate: 0.5,
    alternate_apart: false,
};

fn layout() -> Layout {
    let mut layout = task(5.0, REACH).layout;
    layout.frozen_until_s = 2.0 * DAY_S;
    layout.window_s = 3.0 * DAY_S;
    layout.occupied =
        vec![BusySpan { start_s: 7.25 * DAY_S, stop_s: 8.0 * DAY_S, planned: true, command: 4 }];
    layout
}

#[test]
fn windows_follow_one_another() {
    let sunlit = sunlit([0.0; 3]);
    let (windows, steps) = layout().windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    assert_eq!(steps.len(), 1);
    assert_eq!([windows[0].start_s, windows.last().unwrap().stop_s], [0.0, 20.0 * DAY_S]);
    assert!(windows.windows(2).all(|pair| pair[0].stop_s == pair[1].start_s));
    let kinds: Vec<_> = windows.iter().map(|window| window.kind).collect();
    use WindowKind::{Free, Frozen, Planned};
    assert_eq!(kinds, [Frozen, Free, Free, Planned, Free, Free, Free, Free]);
    assert_eq!(windows[3].command, Some(4));
    assert_eq!([windows[2].start_s, windows[2].stop_s], [5.0 * DAY_S, 7.25 * DAY_S]);
}

/// The arrays may stay where they are, however far off the baseline; tilts are kept within their reach.
#[test]
fn free_windows_begin_with_the_plan_in_force() {
    let sunlit = sunlit([0.0; 3]);
    let mut layout = layout();
    layout.control_bounds.offset_rad = 0.05;
    let present = Controls([0.2, 0.01, 0.05, 0.3, 0.0, 0.0, 0.0]);
    layout.in_force = vec![ActiveControls { at_s: 0.0, controls: present }];
    let (windows, steps) = layout.windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    let baseline_rad = steps[0].offset_rad;
    assert!(baseline_rad > 0.3, "{baseline_rad}");
    let controls = |kind| windows.iter().filter(move |it| it.kind == kind).map(|it| it.controls.0);
    assert!(controls(WindowKind::Free).all(|it| it == [0.2, 0.01, 0.05, REACH.elevation_rad, 0.0, 0.0, 0.0]));
    assert!(controls(WindowKind::Planned).all(|it| it == [baseline_rad, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
    assert_eq!(windows[1].bounds[Control::Offset as usize], [0.2, baseline_rad + 0.05]);
    layout.control_bounds.offset_rad = 0.0;
    let (kept, _) = layout.windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    assert_eq!(kept[1].controls.get(Control::Offset), baseline_rad);
}

#[test]
fn alternation_has_its_share_outside_of_contacts() {
    let sunlit = sunlit([0.0; 3]);
    let mut layout = layout();
    layout.contacts_s =
        (0..20).map(|day| [(f64::from(day) + 0.25) * DAY_S, (f64::from(day) + 0.5) * DAY_S]).collect();
    let (windows, _) = layout.windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    for mut window in windows.into_iter().filter(|window| window.kind == WindowKind::Free) {
        for share in [0.0, 0.1, 0.37, 0.5] {
            window.controls = window.controls.with(Control::Alternate, share);
            let spans = window.alternate_spans_s();
            let total_s: f64 = spans.iter().map(|[from, to]| to - from).sum();
            assert!((total_s - share * window.length_s()).abs() < 1e-6);
            let meets = |[from, to]: &[f64; 2]| {
                layout.contacts_s.iter().any(|contact| contact[0] < to - 1e-6 && contact[1] > from + 1e-6)
            };
            assert!(!spans.iter().any(meets));
            assert!(spans.iter().all(|[from, to]| *from >= window.start_s && *to <= window.stop_s));
        }
    }
}

/// Halves of 6 h in the order +--+.
#[test]
fn equal_parts_are_halves_about_the_middle_of_each_day() {
    let sunlit = sunlit([0.0; 3]);
    let (windows, _) = layout().windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    let mut window = windows[1].clone();
    window.controls = window.controls.with(Control::Alternate, 0.5);
    let spans: Vec<[f64; 2]> = window
        .alternate_spans_s()
        .into_iter()
        .map(|span| span.map(|it| (it - window.start_s) / 3600.0))
        .collect();
    for (index, span) in spans.iter().enumerate() {
        let day_h = 24.0 * index as f64;
        assert!((span[0] - day_h - 6.0).abs() < 1e-9 && (span[1] - day_h - 18.0).abs() < 1e-9, "{span:?}");
    }
    assert_eq!(spans.len(), 3);
}

#[test]
fn a_window_full_of_contact_has_no_alternation() {
    let sunlit = sunlit([0.0; 3]);
    let mut layout = layout();
    layout.contacts_s = vec![[1.9 * DAY_S, 5.1 * DAY_S]];
    let (windows, _) = layout.windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    assert_eq!(windows[1].bounds[Control::Alternate as usize], [0.0, 0.0]);
    layout.contacts_s.clear();
    layout.contact_share = 0.7;
    let (windows, _) = layout.windows(&sunlit, &simulated(&sunlit, 20, 0.4)).unwrap();
    assert!((windows[1].bounds[Control::Alternate as usize][1] - 0.3).abs() < 1e-12);
}
