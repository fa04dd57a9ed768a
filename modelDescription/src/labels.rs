//! Labels of the groups of a description: the user's names, with which their variables' descriptions begin.

use std::collections::BTreeMap;

use crate::description::Description;

/// Text between the label of a group and the description of its variable: `IIIR: Thrust of the thruster.`
pub const LABEL_END: &str = ": ";

/// The label of every numbered group, such as that of `thruster[3]`: what all descriptions of the group begin with, up to the last
/// [`LABEL_END`] that they share. A group whose descriptions are all alike has none, for nothing tells label from description.
pub fn of_groups(description: &Description) -> BTreeMap<&str, &str> {
    let mut shared: BTreeMap<&str, (&str, bool)> = BTreeMap::new();
    for variable in &description.variables {
        let Some(end) = variable.name.rfind("].") else { continue };
        let text = variable.description.as_deref().unwrap_or_default();
        let (common, differs) = shared.entry(&variable.name[..=end]).or_insert((text, false));
        if *common != text {
            let same = common.char_indices().zip(text.chars()).find(|((_, a), b)| a != b);
            let length = same.map_or(common.len().min(text.len()), |((at, _), _)| at);
            (*common, *differs) = (&common[..length], true);
        }
    }
    let labels = shared.into_iter().filter(|(_, (_, differs))| *differs);
    labels.filter_map(|(group, (common, _))| Some((group, &common[..common.rfind(LABEL_END)?]))).collect()
}

#[cfg(test)]
mod tests {
    //! Labels are found with colons in them, and only where all descriptions of a group agree on one.
    use super::*;
    use crate::ScalarVariable;

    fn described(variables: &[(&str, &str)]) -> Description {
        let variable = |(at, (name, text)): (usize, &(&str, &str))| ScalarVariable {
            name: (*name).to_owned(),
            value_reference: at as u32,
            description: Some((*text).to_owned()),
            ..ScalarVariable::default()
        };
        Description {
            variables: variables.iter().enumerate().map(variable).collect(),
            ..Description::default()
        }
    }

    #[test]
    fn a_label_is_what_all_descriptions_of_a_group_begin_with() {
        let description = described(&[
            ("p.plate[1].temperature", "lid: Temperature."),
            ("p.plate[1].force[1]", "lid: Force: of light."),
            ("p.plate[1].force[2]", "lid: Force: of light."),
            ("plate[2].temperature", "back: left: Temperature."),
            ("plate[2].force[1]", "back: left: Force."),
            ("wheel[1].speed", "Speed: of the rotor."),
            ("wheel[1].momentum", "Momentum."),
            ("tank[1].used", "Used: so far."),
            ("slosh[1].a", "Größe: A"),
            ("slosh[1].b", "Größe: Ä"),
            ("mass", "Mass: all of it."),
        ]);
        let labels = of_groups(&description);
        let expected = [("p.plate[1]", "lid"), ("plate[2]", "back: left"), ("slosh[1]", "Größe")];
        assert_eq!(labels.into_iter().collect::<Vec<_>>(), expected);
    }
}
