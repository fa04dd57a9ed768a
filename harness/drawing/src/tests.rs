//! Charts name what they show, lose nothing visible, and survive any data.

use super::{axes::tick_text, chart::*, frame::Frame, *};

fn sample() -> Chart {
    let line = |phase: f64, scale: f64| {
        (0..130_000)
            .map(|k| {
                let day = f64::from(k) * 90.0 / 130_000.0;
                // A sawtooth, as momentum between dumps.
                (day, scale * ((day / 7.0 + phase).fract() * 8.0 - 4.0) + 0.2 * (day * 6.0).sin())
            })
            .collect::<Vec<_>>()
    };
    let momentum = Panel::new("momentum.body [N.m.s]").marks("dump.threshold", vec![4.0, -4.0]).with([
        Series::line("momentum.body[1]", line(0.0, 1.0)),
        Series::line("momentum.body[2]", line(0.4, 0.3)),
        Series::line("momentum.body[3]", line(0.7, -0.6)),
    ]);
    Chart::new("System momentum, thruster dumps only", "time [d]").with([
        Panel { shades: vec![(10.0, 12.0)], shade_label: "eclipse".to_owned(), ..momentum },
        Panel::new("torque.solar [uN.m]").with([Series::line("torque.solar[1]", line(0.1, 20.0))]),
        Panel::new("dump.count")
            .with([Series::dots("", (0..12).map(|k| (f64::from(k) * 7.5, f64::from(k))).collect())]),
    ])
}

#[test]
fn a_chart_names_its_axes_and_stays_small() {
    let svg = svg(&[&sample()]).unwrap();
    for text in [
        "System momentum, thruster dumps only",
        "time [d]",
        "momentum.body [N.m.s]",
        "torque.solar[1]",
        "dump.threshold",
        "eclipse",
    ] {
        assert!(svg.contains(text), "{text} is missing");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "a coordinate is not finite");
    assert!(svg.len() < 1_000_000, "{} bytes", svg.len());
    if let Ok(path) = std::env::var("CHART_SAMPLE") {
        std::fs::write(path, svg).unwrap();
    }
}

#[test]
fn ticks_can_have_names() {
    let modes = Panel {
        names: vec![(1.0, "operational".to_owned()), (2.0, "safeHold".to_owned())],
        ..Panel::new("mode").with([Series::steps("", vec![(0.0, 1.0), (5.0, 2.0)])])
    };
    let x_names = vec![(1.0, "04-06".to_owned()), (9.0, "beyond".to_owned())];
    let svg = svg(&[&Chart { x_names, ..Chart::new("", "UTC").with([modes]) }]).unwrap();
    for text in [">operational<", ">safeHold<", ">04-06<"] {
        assert!(svg.contains(text), "{text} is missing");
    }
    for text in [">beyond<", ">1.0<", ">1<"] {
        assert!(!svg.contains(text), "{text} stands there");
    }
}

#[test]
fn labels_stand_beside_the_numbers_of_their_axes_in_one_line() {
    let panel =
        |most: f64| Panel::new("y").range(0.0, most).with([Series::line("", vec![(0.0, 0.0), (1.0, most)])]);
    let labels = |panels: &[f64]| -> Vec<f64> {
        let svg = svg(&[&Chart::new("", "x").with(panels.iter().copied().map(panel))]).unwrap();
        let turned = svg.split("rotate(-90 ").skip(1);
        turned.map(|rest| rest.split(' ').next().unwrap().parse().unwrap()).collect()
    };
    // Room for `4`, for `40000`, and for both where one stands above the other.
    let (near, far) = (labels(&[5.0])[0], labels(&[5e4])[0]);
    assert!(far < near - 4.0 * 5.0 && near > picture::PLOT_LEFT - 40.0, "{near}, {far}");
    assert_eq!(labels(&[5.0, 5e4]), [far, far]);
}

#[test]
fn a_band_is_named_once() {
    let fast = |count: u32| {
        let line = (0..count).map(|k| (f64::from(k), (1.3 * f64::from(k)).sin())).collect();
        Panel::new("torque").with([Series::line("a", line)])
    };
    let count = |chart: Chart| svg(&[&chart]).unwrap().matches("range and mean of an oscillation").count();
    assert_eq!(count(Chart::new("", "time [d]").with([fast(10), fast(100_000), fast(100_000)])), 1);
    assert_eq!(count(Chart::new("", "time [d]").with([fast(10)])), 0);
}

#[test]
fn thinning_keeps_every_spike() {
    let mut points: Vec<(f64, f64)> = (0..100_000).map(|k| (f64::from(k), 0.0)).collect();
    points[31_415].1 = 7.0;
    points[27_182].1 = -3.0;
    let kept = chart::thinned(&points, [0.0, 99_999.0]);
    assert!(kept.len() <= 8000);
    assert!(kept.contains(&(31_415.0, 7.0)) && kept.contains(&(27_182.0, -3.0)));
    assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[99_999]));
    assert!(kept.is_sorted_by(|a, b| a.0 < b.0));
}

#[test]
fn odd_data_is_drawn_or_refused_but_never_panics() {
    let chart = |points: Vec<(f64, f64)>| Chart {
        panels: vec![Panel::new("").with([Series::line("x", points)])],
        ..Chart::default()
    };
    assert!(svg(&[&chart(vec![])]).is_err());
    assert!(svg(&[&chart(vec![(0.0, f64::NAN)])]).is_err());
    for points in [
        vec![(0.0, 0.0)],
        vec![(5.0, 1e300), (6.0, 1e300)],
        vec![(5.0, 5e-324), (6.0, 5e-324)],
        vec![(5.0, 3e-308), (6.0, 3e-308)],
        vec![(0.0, 1.0), (1.0, f64::INFINITY), (2.0, 1.0 + 1e-16)],
        vec![(1e-300, -1e-300), (2e-300, 1e-300)],
        vec![(-1e15, 3.0), (1e15, 4.0)],
        vec![(0.0, 1.0), (1.0, 1e308), (2.0, -1e308), (3.0, 2.0)],
    ] {
        let band = Envelope { lowest: points.clone(), greatest: points.clone() };
        let band = Band { label: String::new(), range: band };
        let drawn = Chart {
            panels: vec![Panel::new("").with([Series::curve("x", points.clone()).with_bands([band])])],
            ..Chart::default()
        };
        for svg in [svg(&[&chart(points.clone())]), svg(&[&drawn])] {
            let svg = svg.unwrap();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{points:?}: {svg}");
        }
    }
}

/// The points of the first series, in px.
fn drawn_line(svg: &str) -> Vec<(f64, f64)> {
    let tag = svg.split("<path ").find(|tag| tag.contains("stroke=\"#0072b2\"")).unwrap();
    let points = tag.split('"').nth(1).unwrap().trim_start_matches('M').split('L');
    let number = |text: &str| text.parse::<f64>().unwrap();
    points.map(|pair| pair.split_once(',').unwrap()).map(|(x, y)| (number(x), number(y))).collect()
}

#[test]
fn a_smooth_curve_is_no_staircase() {
    // A ramp that rises by 20 pixels over the width of the picture.
    let points = (0..=400).map(|k| (f64::from(k), f64::from(k))).collect();
    let panel = Panel::new("").range(0.0, 6000.0).with([Series::line("x", points)]);
    let svg = svg(&[&Chart { panels: vec![panel.clone(), panel], ..Chart::default() }]).unwrap();
    assert!(svg.contains(" width=\"960\" ") && svg.contains(" viewBox=\"0 0 960 "));
    let line = drawn_line(&svg);
    let ((x0, y0), (x1, y1)) = (line[0], line[line.len() - 1]);
    for (x, y) in &line {
        let on_the_line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
        assert!((y - on_the_line).abs() < 0.25, "{x},{y}: {} pixels off", y - on_the_line);
    }
}

#[test]
fn a_flat_line_has_a_readable_axis() {
    assert_eq!(padded(0.0, 0.0), [-1.0, 1.0]);
    assert_eq!(padded(20.0, 20.0), [18.0, 22.0]);
    assert_eq!(padded(-1e-15, -1e-15), [-1e-15 - 1e-16, -1e-15 + 1e-16]);
}

#[test]
fn ticks_read_well() {
    assert_eq!((round_up(9.0), round_up(10.0)), (10.0, 10.0));
    assert_eq!(ticks([-1.0, 1.0], 0.5), [-1.0, -0.5, 0.0, 0.5, 1.0]);
    assert_eq!((ticks([0.0, 1.0], 0.0), ticks([0.0, f64::INFINITY], 1.0).len()), (vec![], 101));
    assert_eq!(
        (tick_text(0.30000000000000004, 0.1), tick_text(-0.0, 5.0)),
        ("0.3".to_owned(), "0".to_owned())
    );
    assert_eq!(tick_text(-0.1 - 0.2, 0.1), "-0.3");
    assert_eq!(tick_text(1e-20, 0.5), "0.0");
    assert_eq!(tick_text(2e-9, 1e-9), "2e-9");
    assert_eq!(tick_text(1_500_000.0, 500_000.0), "1.5e6");
    assert_eq!(tick_text(20.0, 10.0), "20");
}

/// A limit's dashes and the rings about dots are drawn, and stand in the legend as they are drawn.
#[test]
fn dashes_and_rings_are_reported_from_lines_and_dots() {
    let points = vec![(0.0, 1.0), (4.0, 2.0), (8.0, 1.5)];
    let svg = |series: Series| {
        let range = Some((0.0, 3.0));
        let panel = Panel { series: vec![series], y_range: range, ..Panel::default() };
        crate::svg(&[&Chart { panels: vec![panel], ..Chart::default() }]).unwrap()
    };
    let count = |text: &str, part: &str| text.matches(part).count();
    let (line, dashed) = (svg(Series::line("a", points.clone())), svg(Series::dashed("a", points.clone())));
    // The line and the legend's.
    assert_eq!((count(&dashed, "stroke-dasharray"), count(&line, "stroke-dasharray")), (2, 0));
    let (dots, rings) = (svg(Series::dots("a", points.clone())), svg(Series::rings("a", points)));
    // Three points and the legend's.
    assert_eq!((count(&dots, "<circle"), count(&rings, "<circle")), (4, 4));
    let hollow = |text: &str| {
        text.lines().filter(|line| line.contains("<circle") && line.contains("fill=\"none\"")).count()
    };
    assert_eq!((hollow(&dots), hollow(&rings)), (0, 4));
}

#[test]
fn flags_and_counts_have_whole_ticks() {
    for greatest in [1.0, 2.0, 3.0, 40.0] {
        let steps = Series::steps("", vec![(0.0, 0.0), (1.0, greatest), (2.0, greatest)]);
        let panel = Panel::new("count").whole().with([steps]);
        let svg = svg(&[&Chart { panels: vec![panel; 2], ..Chart::default() }]).unwrap();
        let texts: Vec<&str> = svg
            .split("</text>")
            .filter_map(|text| text.rsplit_once('>').map(|(_, text)| text.trim()))
            .filter(|text| !text.is_empty())
            .collect();
        assert!(texts.contains(&"0") && texts.len() > 4, "{texts:?}");
        if greatest <= 3.0 {
            assert!(texts.contains(&format!("{greatest}").as_str()), "{greatest}: {texts:?}");
        }
    }
}

#[test]
fn a_staircase_holds_each_value_until_the_next() {
    let steps = Series::steps("", vec![(0.0, 1.0), (1.0, 1.0), (2.0, 3.0), (3.0, 2.0)]);
    assert_eq!(steps.corners(), [(0.0, 1.0), (1.0, 1.0), (2.0, 1.0), (2.0, 3.0), (3.0, 3.0), (3.0, 2.0)]);
}

#[test]
fn what_lies_outside_of_a_frame_is_not_seen() {
    let frame = Frame { left: 10.0, top: 20.0, width: 100.0, height: 50.0, x: [0.0, 1.0], y: [0.0, 1.0] };
    let points = vec![(-1.0, 0.5), (0.5, 0.5), (0.6, 1e300)];
    let mut pen = Pen::new(200.0, 100.0, "");
    draw_series(&mut pen, &frame, 0, &Series::dots("", points.clone()), <[(f64, f64)]>::to_vec);
    draw_series(&mut pen, &frame, 0, &Series::line("", points), <[(f64, f64)]>::to_vec);
    let svg = pen.finish();
    assert_eq!(svg.matches("<circle").count(), 1, "{svg}");
    assert!(svg.contains("<svg x=\"10.0\" y=\"20.0\" width=\"100.0\" height=\"50.0\""), "{svg}");
    assert!(svg.len() < 1000, "{svg}");
    // The line ends at the frame: beyond it the picture is white.
    let png = resvg::tiny_skia::Pixmap::decode_png(&png(&svg).unwrap()).unwrap();
    let is_white = |x: u32, y: u32| png.pixel(x, y).unwrap().green() == 255;
    assert!((0..10).all(|x| is_white(x, 45)) && !is_white(20, 45) && (0..20).all(|y| is_white(70, y)));
}

#[test]
fn bands_lie_under_their_line_and_are_named() {
    let edge =
        |value: f64| vec![(0.0, value), (1.0, 2.0 * value), (2.0, f64::NAN), (3.0, value), (4.0, value)];
    let band = |label: &str, half: f64| Band {
        label: label.to_owned(),
        range: Envelope { lowest: edge(-half), greatest: edge(half) },
    };
    let line = (0..5).map(|k| (f64::from(k), 0.0)).collect();
    let series = Series::line("median", line).with_bands([band("5 to 95 %", 10.0), band("25 to 75 %", 4.0)]);
    let svg = svg(&[&Chart::new("", "time [d]").with([Panel::new("h").with([series])])]).unwrap();
    for text in [">median<", ">5 to 95 %<", ">25 to 75 %<"] {
        assert!(svg.contains(text), "{text} is missing");
    }
    // Two bands of two pieces each, before the line.
    let polygons: Vec<usize> = svg.match_indices("<polygon").map(|(at, _)| at).collect();
    let line = svg.find("stroke-linejoin").unwrap();
    assert!(polygons.len() == 4 && polygons.iter().all(|at| *at < line), "{svg}");
    assert!(svg.contains(">20<") && svg.contains(">-20<"), "the axis leaves out the bands: {svg}");
}

#[test]
fn a_histogram_has_a_bar_for_each_count_above_zero() {
    let counts = Series::bars("", vec![(0.0, 3.0), (1.0, 0.0), (2.0, 6.0), (3.0, 0.0)]);
    let panel = Panel::new("runs").whole().range(0.0, 6.0).with([counts]);
    let svg = svg(&[&Chart::new("", "x").with([panel])]).unwrap();
    let number = |tag: &str, key: &str| -> f64 {
        tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let bars: Vec<&str> = svg.split("<rect ").filter(|tag| tag.contains("fill=\"#0072b2\"")).collect();
    let [low, high] = bars[..] else { panic!("{svg}") };
    assert!((number(high, " height") - 2.0 * number(low, " height")).abs() < 0.2);
    assert!((number(high, " width") - number(low, " width")).abs() < 0.2);
    assert!((number(high, "x") - number(low, "x") - 2.0 * number(low, " width")).abs() < 0.2);
}

#[test]
fn dots_that_others_hide_are_left_out_where_there_are_many() {
    let count = |points: Vec<(f64, f64)>| {
        let panel = Panel::new("").range(0.0, 1.0).with([Series::dots("", points)]);
        svg(&[&Chart::new("", "").with([panel])]).unwrap().matches("<circle").count()
    };
    let many = |all: u32| (0..all).map(|k| (f64::from(k % 10), f64::from(k % 2))).collect::<Vec<_>>();
    assert_eq!(count(many(2000)), 2000);
    assert_eq!(count(many(20_000)), 10);
}
