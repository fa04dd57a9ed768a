//! The picture of `run`: one panel per vector or variable, in display units.

use std::{
    collections::BTreeMap,
    error::Error,
    path::{Path, PathBuf},
};

use drawing::{COLOURS, Chart, Mark, Panel, Series};
use files::Destination;
use fmi::{Column, Recording};
use model_description::{Causality, Description, ScalarVariable, VariableRole, value};

use super::{
    display_context::DisplayContext,
    display_form::ANGLE_UNIT,
    exporter::Exporter,
    scales::{ROUNDING, Scales, group},
    time_axis::TimeAxis,
};

/// Panels drawn at most; more would not be readable.
const PANELS: usize = 10;

/// Leaves out what a picture has no panels for, with a note; `what` panels are of, `see` what chooses them.
pub fn leave_out<T>(panels: &mut Vec<T>, what: &str, see: &str) {
    if let Some(beyond) = panels.len().checked_sub(PANELS).filter(|beyond| *beyond > 0) {
        terminal::note(&format!("the picture shows the first {PANELS} {what} and leaves out {beyond}{see}"));
        panels.truncate(PANELS);
    }
}

/// Eclipses shaded at most; more would be stripes.
const ECLIPSES: usize = 60;

/// The picture, drawn at the end.
pub(super) struct Svg {
    /// Destination, to which nothing is written yet.
    pub file: Destination,
    /// The variables that it shows; `None`: everything recorded.
    pub names: Option<Vec<String>>,
    /// Names and bounds of the variables.
    pub context: DisplayContext,
}

impl Svg {
    fn draw(&self, described: &Description, recording: &Recording) -> Result<String, Box<dyn Error>> {
        let only = self.names.as_ref().map(|names| recording.only(names));
        let recorded = only.as_ref().unwrap_or(recording);
        let (mut chart, seconds) = chart(described, recorded, &self.context, "--record");
        shade_eclipses(&mut chart, (described, recording), seconds);
        Ok(drawing::svg(&[&chart])?)
    }
}

/// Shades the times at which the Sun was not whole, where that is recorded, in all panels of a chart; its unit of time is `seconds`.
pub fn shade_eclipses(chart: &mut Chart, (described, recording): (&Description, &Recording), seconds: f64) {
    let mut eclipses = eclipses(described, recording, seconds);
    if eclipses.len() > ECLIPSES {
        terminal::note(&format!("{} eclipses, so not shaded", eclipses.len()));
        eclipses.clear();
    }
    for panel in &mut chart.panels {
        panel.shades.clone_from(&eclipses);
    }
    if let Some(first) = chart.panels.first_mut().filter(|_| !eclipses.is_empty()) {
        first.shade_label = "eclipse".to_owned();
    }
}

impl Exporter for Svg {
    fn existing(&self) -> Option<&Path> {
        self.file.existing()
    }

    fn finish(self: Box<Self>, described: &Description, recording: &Recording) -> Result<(), Box<dyn Error>> {
        let svg = self.draw(described, recording)?;
        Ok(self.file.fill(|file| file.write_all(svg.as_bytes()))?)
    }

    fn leave(self: Box<Self>, described: &Description, recording: &Recording) -> Option<PathBuf> {
        if recording.times_s.is_empty() {
            return None;
        }
        let svg = self.draw(described, recording).ok()?;
        let mut file = self.file.grow(&[]).ok()?;
        file.append(svg.as_bytes()).ok()?;
        file.leave()
    }
}

/// The chart of a recording, and how many seconds a unit of its horizontal axis has; `option` is what chooses its variables.
pub fn chart(
    described: &Description,
    recording: &Recording,
    context: &DisplayContext,
    option: &str,
) -> (Chart, f64) {
    let ends_s = recording.times_s.first().zip(recording.times_s.last());
    let axis = TimeAxis::over(
        ends_s.map_or([0.0; 2], |(first_s, last_s)| [*first_s, *last_s]),
        context.zero_epoch_s,
    );
    let mut groups = groups(described, recording, context, axis.seconds);
    let constant = leave_out_constants(&mut groups);
    if !constant.is_empty() {
        terminal::note(&format!("constant, so not drawn: {}", constant.join(", ")));
    }
    if let Some(beyond) = groups.get(PANELS..) {
        let left_out: usize = beyond.iter().map(|group| group.panel.series.len()).sum();
        if left_out > 0 {
            let limit = format!("the picture shows the first {PANELS} panels");
            terminal::note(&format!("{limit} and leaves out {left_out} variables: see {option}"));
        }
        groups.truncate(PANELS);
    }
    let vectors = groups.iter().filter(|group| group.is_vector()).count();
    let panels = groups.into_iter().map(|group| group.labelled(vectors > 1, context)).collect();
    let legend =
        if vectors > 1 { AXES[..3].iter().map(|axis| (*axis).to_owned()).collect() } else { Vec::new() };
    let TimeAxis { seconds, label, names } = axis;
    let title = described.model_name.clone();
    (Chart { title, x_label: label, panels, legend, x_names: names }, seconds)
}

/// Panel of one variable with its line, over an axis whose unit is `seconds`.
pub fn panel(described: &Description, recording: &Recording, variable: &str, seconds: f64) -> Option<Panel> {
    // With those that it is large or small against.
    let of_variable = group(variable);
    let together: Vec<String> =
        recording.names.iter().filter(|name| group(name) == of_variable).cloned().collect();
    let groups = groups(described, &recording.only(&together), &DisplayContext::default(), seconds);
    groups.into_iter().find_map(|Group { name, mut panel, .. }| {
        panel.series.retain(|series| series.label == variable);
        let unit = panel.y_label.strip_prefix(name.as_str()).unwrap_or_default();
        let y_label = format!("{variable}{unit}");
        (!panel.series.is_empty()).then_some(Panel { y_label, ..panel })
    })
}

/// Groups of variables that are drawn together, in the order of the recording.
fn groups(
    described: &Description,
    recording: &Recording,
    context: &DisplayContext,
    seconds: f64,
) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    // The panel of a name and a label that has room for another line.
    let mut with_room: BTreeMap<(String, String), usize> = BTreeMap::new();
    let (variables, scales) = (by_name(described), Scales::new(described, recording));
    for (name, column) in drawn(&variables, recording) {
        let vector = group(name);
        let variable = variables.get(name).copied();
        let display = variable.and_then(|variable| fmi::display_unit(described, variable));
        let own = variable.and_then(|variable| fmi::unit(described, variable)).unwrap_or_default();
        let (unit, factor, offset) = display.unwrap_or((own, 1.0, 0.0));
        let points = recording.times_s.iter().zip(column.numbers());
        let points = points.map(|(time_s, value)| (time_s / seconds, factor * value + offset)).collect();
        let series = match column {
            Column::Real(_) => Series::line(name, points),
            _ => Series::steps(name, points),
        };
        let y_label =
            if unit.is_empty() || unit == "1" { vector.clone() } else { format!("{vector} [{unit}]") };
        // What belongs together may stand apart in the description: wheel[1].momentum, wheel[1].speed, wheel[2]...
        let key = (vector, y_label);
        let with_space = with_room.get(&key).copied();
        let with_space = with_space.filter(|at| groups[*at].panel.series.len() < COLOURS.len());
        let position = with_space.unwrap_or_else(|| {
            let is_of_angles = own == ANGLE_UNIT;
            let size = factor.abs() * if is_of_angles { 1.0 } else { scales.size(name) };
            groups.push(Group::new(key.0.clone(), key.1.clone(), Scale { size, is_of_angles }));
            with_room.insert(key, groups.len() - 1);
            groups.len() - 1
        });
        groups[position].name_values(described, variable, &series);
        groups[position].add(series, context, |value| factor * value + offset);
    }
    groups.iter_mut().for_each(Group::still);
    groups.iter_mut().for_each(|group| group.panel.names.sort_by(|a, b| a.0.total_cmp(&b.0)));
    groups
}

/// Components of vectors and, with the scalar last, of quaternions.
const AXES: [&str; 4] = ["x", "y", "z", "w"];

/// A panel with its name.
struct Group {
    name: String,
    panel: Panel,
    /// Marks that are drawn only near the lines, with what they are.
    bounds: Vec<(String, f64)>,
    scale: Scale,
}

/// Size that values are large or small against.
#[derive(Clone, Copy)]
struct Scale {
    size: f64,
    /// Whether that is a radian, by which their variation is judged too.
    is_of_angles: bool,
}

impl Group {
    fn new(name: String, y_label: String, scale: Scale) -> Self {
        let panel = Panel { y_label, is_whole: true, ..Panel::default() };
        Self { name, panel, bounds: Vec::new(), scale }
    }

    fn add(&mut self, series: Series, context: &DisplayContext, shown: impl Fn(f64) -> f64) {
        if let Some((what, value)) = context.bound(&series.label) {
            self.bounds.extend([-value, value].map(|value| (what.to_owned(), shown(value))));
        }
        self.panel.marks.extend(context.limits(&series.label).iter().map(|value| shown(*value)));
        self.panel.is_whole &= series.mark == Mark::Steps;
        self.panel.series.push(series);
    }

    /// Names the values of an Enumeration that it takes.
    fn name_values(&mut self, described: &Description, variable: Option<&ScalarVariable>, series: &Series) {
        for item in variable.map_or(&[][..], |variable| value::items(described, variable)) {
            let value = f64::from(item.value);
            let is_taken = series.points.iter().any(|(_, taken)| *taken == value);
            if is_taken && self.panel.names.iter().all(|(named, _)| *named != value) {
                self.panel.names.push((value, item.name.clone()));
            }
        }
    }

    fn values(&self) -> impl Iterator<Item = f64> {
        let points = self.panel.series.iter().flat_map(|series| &series.points);
        points.map(|(_, value)| *value).filter(|value| value.is_finite())
    }

    /// Makes lines that vary by nothing but rounding straight, and 0 where they are nothing else.
    fn still(&mut self) {
        let largest = self.values().fold(0.0, |largest: f64, value| largest.max(value.abs()));
        let Scale { size, is_of_angles } = self.scale;
        let [rounding, straight] = [size, if is_of_angles { size } else { largest }].map(|it| ROUNDING * it);
        for series in self.panel.series.iter_mut().filter(|series| series.mark == Mark::Line) {
            let values = || series.points.iter().map(|(_, value)| *value);
            let (low, high) = range(values());
            let value = match values().next() {
                _ if !values().all(f64::is_finite) => continue,
                Some(_) if low.abs().max(high.abs()) < rounding => 0.0,
                Some(first) if high - low < straight => first,
                _ => continue,
            };
            series.points.iter_mut().for_each(|point| point.1 = value);
        }
    }

    fn is_constant(&self) -> bool {
        self.panel.series.iter().all(|series| {
            let mut values = series.points.iter().map(|(_, value)| value);
            values.next().is_some_and(|first| values.all(|value| value == first))
        })
    }

    /// Whether its lines are x, y and z of one vector.
    fn is_vector(&self) -> bool {
        let of_vector = |(k, series): (usize, &Series)| series.label == format!("{}[{}]", self.name, k + 1);
        self.panel.series.len() == 3 && self.panel.series.iter().enumerate().all(of_vector)
    }

    /// The panel with its lines named, and the bounds that are near them.
    fn labelled(mut self, is_shared: bool, context: &DisplayContext) -> Panel {
        let (low, high) = range(self.values());
        let reach = (high - low).max(low.abs()).max(high.abs());
        let is_near = |mark: &f64| *mark > low - reach && *mark < high + reach;
        let near: Vec<_> = self.bounds.iter().filter(|(_, mark)| is_near(mark)).collect();
        let limit = (!self.panel.marks.is_empty()).then_some("limit");
        let mut labels: Vec<&str> = near.iter().map(|(what, _)| what.as_str()).chain(limit).collect();
        labels.dedup();
        self.panel.mark_label = labels.join(", ");
        self.panel.marks.extend(near.iter().map(|(_, mark)| mark));
        self.panel.marks.sort_by(f64::total_cmp);
        self.panel.marks.dedup();
        let is_vector = self.is_vector();
        let is_alone = matches!(self.panel.series.as_slice(), [only] if only.label == self.name);
        let components = self.panel.series.len() <= AXES.len();
        for series in &mut self.panel.series {
            let index = series
                .label
                .strip_prefix(&self.name)
                .and_then(|rest| rest.strip_prefix('[')?.strip_suffix(']')?.parse::<usize>().ok());
            let axis = index.filter(|_| components).and_then(|index| AXES.get(index.checked_sub(1)?));
            // A lone variable is named by its axis, the components of vectors by the legend beside the title.
            series.label = if is_alone || is_vector && is_shared {
                String::new()
            } else if let Some(axis) = axis {
                (*axis).to_owned()
            } else {
                context.name(&series.label).map_or_else(|| series.label.clone(), str::to_owned)
            };
        }
        self.panel
    }
}

/// The least and the greatest value.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

/// Takes out what stays the same, unless nothing else is there; their names with their values.
fn leave_out_constants(groups: &mut Vec<Group>) -> Vec<String> {
    /// More are only counted.
    const NAMED: usize = 5;
    if groups.iter().all(Group::is_constant) {
        return Vec::new();
    }
    let (constant, varying): (Vec<Group>, Vec<Group>) =
        std::mem::take(groups).into_iter().partition(Group::is_constant);
    *groups = varying;
    let named = constant.iter().take(NAMED).map(|group| {
        let values: Vec<String> = group
            .panel
            .series
            .iter()
            .filter_map(|series| {
                let value = series.points.first()?.1;
                let name = group.panel.names.iter().find(|(named, _)| *named == value);
                Some(name.map_or_else(|| terminal::short(value), |(_, name)| name.clone()))
            })
            .collect();
        format!("{} = {}", group.panel.y_label, values.join(", "))
    });
    let mut named: Vec<String> = named.collect();
    if constant.len() > NAMED {
        named.push(format!("{} more", constant.len() - NAMED));
    }
    named
}

/// Spans in which the Sun is not whole by the recorded part of its disc, in units of `seconds`.
fn eclipses(described: &Description, recording: &Recording, seconds: f64) -> Vec<(f64, f64)> {
    let lit: Vec<&String> = described.with_role(VariableRole::LitFraction).map(|it| &it.name).collect();
    let Some(position) = recording.names.iter().position(|name| lit.contains(&name)) else {
        return Vec::new();
    };
    let lit = recording.columns[position].numbers();
    let mut spans: Vec<(f64, f64)> = Vec::new();
    let mut since = None;
    for (time_s, lit) in recording.times_s.iter().zip(&lit) {
        match (since, *lit < 1.0) {
            (None, true) => since = Some(*time_s),
            (Some(from_s), false) => {
                spans.push((from_s / seconds, time_s / seconds));
                since = None;
            }
            _ => {}
        }
    }
    let last_s = recording.times_s.last().copied();
    spans.extend(since.zip(last_s).map(|(from_s, last_s)| (from_s / seconds, last_s / seconds)));
    spans
}

/// Variables by name.
fn by_name(described: &Description) -> BTreeMap<&str, &ScalarVariable> {
    described.variables.iter().map(|variable| (variable.name.as_str(), variable)).collect()
}

/// The columns worth drawing: no texts, and no inputs that nobody used, unless there is nothing else.
fn drawn<'a>(
    variables: &BTreeMap<&str, &ScalarVariable>,
    recording: &'a Recording,
) -> Vec<(&'a str, &'a Column)> {
    let columns = recording.names.iter().map(String::as_str).zip(&recording.columns);
    let numbers: Vec<_> = columns.filter(|(_, column)| !matches!(column, Column::Text(_))).collect();
    let unused = |name: &str, column: &Column| {
        variables.get(name).is_some_and(|variable| variable.causality == Causality::Input)
            && column.numbers().iter().all(|value| *value == 0.0)
    };
    let used: Vec<_> = numbers.iter().copied().filter(|(name, column)| !unused(name, column)).collect();
    if used.is_empty() { numbers } else { used }
}

#[cfg(test)]
mod tests;
