//! A panel is square, and nothing to show is an error.
use super::*;

#[test]
fn a_panel_is_square_and_an_empty_picture_an_error() {
    let panel = PlanePanel { half_width: 2.0, title: "left".to_owned(), ..PlanePanel::default() };
    let chart = PlaneChart { title: "two".to_owned(), panels: vec![panel; 2], ..PlaneChart::default() };
    let svg = crate::svg(&[&chart]).unwrap();
    assert!(svg.contains(" width=\"960\" ") && svg.matches("left").count() == 2);
    assert!(crate::svg(&[&PlaneChart::default()]).is_err());
}

#[test]
fn a_panel_of_two_scales_fills_its_square() {
    let corners = vec![(-1.0, -100.0), (1.0, -100.0), (1.0, 100.0), (-1.0, 100.0)];
    let panel = PlanePanel {
        cells: vec![(corners, 0.5)],
        half_width: 1.0,
        half_height: Some(100.0),
        ..PlanePanel::default()
    };
    let shading = Some(Shading { least: -1.0, greatest: 1.0, unit: "N".to_owned() });
    let svg = crate::svg(&[&PlaneChart { panels: vec![panel], shading, ..PlaneChart::default() }]).unwrap();
    let path = svg.split("<path d=\"M").nth(1).unwrap().split('z').next().unwrap();
    let number = |text: &str| text.parse::<f64>().unwrap();
    let places: Vec<Pixel> = path
        .split('L')
        .map(|pair| pair.split_once(',').unwrap())
        .map(|(x, y)| (number(x), number(y)))
        .collect();
    let side = GREATEST_SIDE;
    assert!((places[1].0 - places[0].0 - side).abs() < 0.2 && (places[1].1 - places[2].1 - side).abs() < 0.2);
    assert!(svg.contains(">-1.0<") && svg.contains(">1.0<") && svg.contains(">N<"), "{svg}");
}

#[test]
fn names_stay_inside_the_panel_and_off_one_another() {
    let names: Vec<_> = [(-1.98, 0.0), (1.98, 1.98), (0.0, 0.0), (0.02, 0.0)]
        .into_iter()
        .zip(["left", "corner", "here", "beside"])
        .map(|(at, name)| (at, name.to_owned()))
        .collect();
    let panel = PlanePanel { half_width: 2.0, names, ..PlanePanel::default() };
    let svg = crate::svg(&[&PlaneChart { panels: vec![panel], ..PlaneChart::default() }]).unwrap();
    let number = |tag: &str, key: &str| -> f64 {
        tag.split(&format!(" {key}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let tags = svg.split("<rect ").skip(1).filter_map(|it| it.split('>').next());
    let frame = tags.into_iter().find(|tag| tag.contains("fill=\"none\"")).unwrap();
    let frame = format!(" {frame}");
    let (left, width) = (number(&frame, "x"), number(&frame, "width"));
    let (top, height) = (number(&frame, "y"), number(&frame, "height"));
    let placed = ["left", "corner", "here", "beside"].map(|name| {
        let tag = svg.split("<text").find(|tag| tag.contains(&format!(">{name}<"))).unwrap();
        let half = 0.5 * width_px(name, NAME_SIZE);
        let (x, y) = (number(tag, "x"), number(tag, "y"));
        assert!(x - half >= left && x + half <= left + width, "{name}: {x}");
        assert!(y - NAME_SIZE >= top && y <= top + height, "{name}: {y}");
        (x, y, half)
    });
    for (k, (x, y, half)) in placed.iter().enumerate() {
        for (other_x, other_y, other_half) in &placed[..k] {
            let is_apart = (x - other_x).abs() >= half + other_half || (y - other_y).abs() >= NAME_SIZE;
            assert!(is_apart, "{placed:?}");
        }
    }
}
