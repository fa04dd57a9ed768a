//! Convex sets of the plane as their corners, counter-clockwise: hull, sum, part within a band.

/// A point of the plane of X and Z.
pub type Point = [f64; 2];

/// A convex set; a point has one corner, a segment two, the empty set none.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Region {
    /// Its corners.
    pub corners: Vec<Point>,
}

/// Directions of edges that differ by less than this are one, in rad.
const SAME: f64 = 1e-9;

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

impl Region {
    /// The hull of points (Andrew's monotone chain).
    pub fn hull(points: impl IntoIterator<Item = Point>) -> Self {
        let mut points: Vec<Point> = points.into_iter().collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        points.dedup();
        if points.len() < 3 {
            return Self { corners: points };
        }
        let half = |points: &mut dyn Iterator<Item = &Point>| {
            let mut kept: Vec<Point> = Vec::new();
            for &point in points {
                while let [.., a, b] = kept[..]
                    && cross(minus(b, a), minus(point, a)) <= 0.0
                {
                    kept.pop();
                }
                kept.push(point);
            }
            kept.pop();
            kept
        };
        let mut corners = half(&mut points.iter());
        corners.extend(half(&mut points.iter().rev()));
        Self { corners }
    }

    /// Every point times a number, then moved.
    pub fn scaled(&self, factor: f64, by: Point) -> Self {
        let corner = |corner: &Point| [factor * corner[0] + by[0], factor * corner[1] + by[1]];
        // A negative factor turns the plane by half a turn, so that the order stays.
        Self { corners: self.corners.iter().map(corner).collect() }
    }

    /// The edges, from the lowest of the leftmost corners.
    fn edges(&self) -> (Option<Point>, Vec<Point>) {
        let order = |k: &usize| self.corners[*k];
        let first = (0..self.corners.len())
            .min_by(|a, b| order(a)[0].total_cmp(&order(b)[0]).then(order(a)[1].total_cmp(&order(b)[1])));
        let Some(first) = first else { return (None, Vec::new()) };
        let count = self.corners.len();
        let edge = |k: usize| minus(self.corners[(first + k + 1) % count], self.corners[(first + k) % count]);
        let edges = (0..count).map(edge).filter(|edge| *edge != [0.0; 2]).collect();
        (Some(self.corners[first]), edges)
    }

    /// All sums of a point of each (Minkowski): their edges by direction.
    pub fn plus(&self, other: &Self) -> Self {
        let ((Some(a), one), (Some(b), two)) = (self.edges(), other.edges()) else { return Self::default() };
        // All anew: an edge as short as rounding may point anywhere, and would lead a merge of two lists astray.
        let mut all: Vec<(f64, Point)> = one.into_iter().chain(two).map(|edge| (turn(edge), edge)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut edges: Vec<Point> = Vec::with_capacity(all.len());
        for (_, edge) in all {
            match edges.last_mut() {
                Some(last) if is_same(*last, edge) => *last = [last[0] + edge[0], last[1] + edge[1]],
                _ => edges.push(edge),
            }
        }
        let mut at = [a[0] + b[0], a[1] + b[1]];
        let mut corners = vec![at];
        // The last edge leads back to the first corner.
        for edge in edges.iter().take(edges.len().saturating_sub(1)) {
            at = [at[0] + edge[0], at[1] + edge[1]];
            corners.push(at);
        }
        Self { corners }
    }

    /// The part with each coordinate within plus and minus its limit (Sutherland and Hodgman).
    pub fn within(&self, limits: Point) -> Self {
        let mut corners = self.corners.clone();
        for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            let inside = |corner: &Point| limits[axis] - sign * corner[axis];
            let mut kept: Vec<Point> = Vec::with_capacity(corners.len() + 2);
            for (k, a) in corners.iter().enumerate() {
                let b = corners[(k + 1) % corners.len()];
                let (from, to) = (inside(a), inside(&b));
                if from >= 0.0 {
                    kept.push(*a);
                }
                if (from >= 0.0) != (to >= 0.0) {
                    let part = from / (from - to);
                    let mut cut = [0, 1].map(|k| a[k] + part * (b[k] - a[k]));
                    cut[axis] = sign * limits[axis];
                    kept.push(cut);
                }
            }
            kept.dedup();
            if kept.len() > 1 && kept.first() == kept.last() {
                kept.pop();
            }
            corners = kept;
        }
        Self { corners }
    }

    /// Whether it holds a point.
    pub fn holds(&self, point: Point) -> bool {
        let count = self.corners.len();
        count > 2
            && (0..count).all(|k| {
                let (a, b) = (self.corners[k], self.corners[(k + 1) % count]);
                cross(minus(b, a), minus(point, a)) >= 0.0
            })
    }

    /// Least and greatest of a coordinate.
    pub fn extent(&self, axis: usize) -> [f64; 2] {
        let along = || self.corners.iter().map(|corner| corner[axis]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    }
}

/// Direction of an edge from straight down counter-clockwise, which itself comes last, in rad.
fn turn(edge: Point) -> f64 {
    let angle = edge[0].atan2(-edge[1]);
    if angle > 0.0 { angle } else { angle + core::f64::consts::TAU }
}

fn is_same(a: Point, b: Point) -> bool {
    let sizes = a[0].hypot(a[1]) * b[0].hypot(b[1]);
    cross(a, b).abs() <= SAME * sizes && a[0] * b[0] + a[1] * b[1] > 0.0
}

#[cfg(test)]
mod tests;
