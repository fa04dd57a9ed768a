//! `fmi-ls-manifest.xml`: which related files an FMU has, and what they are for.

use std::fmt::Write;

use files::ANNOTATION;
use model_description::{Start, Xml, escape};

/// The folder of the layered standard inside an FMU.
pub const FOLDER: &str = "extra/org.fmi-standard.fmi-ls-ref";
/// Its list of files.
pub const MANIFEST: &str = "fmi-ls-manifest.xml";

/// The files that an FMU lists.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Manifest {
    /// One each, in the order of the list.
    pub related: Vec<Related>,
}

/// A file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Related {
    /// MIME type.
    pub kind: String,
    /// Path, relative to the manifest.
    pub source: String,
    /// Role of the file.
    pub role: String,
    /// In words.
    pub description: String,
    /// How its results were simulated.
    pub flight: Option<ReferenceSimulation>,
}

/// How results were simulated and how near they are met.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceSimulation {
    /// Greatest deviation, as a fraction of the largest magnitude of a vector or scalar.
    pub tolerance: f64,
    /// The table of inputs, from the manifest.
    pub inputs: Option<String>,
}

impl Manifest {
    /// Reads the file.
    ///
    /// # Errors
    /// What is not XML or not this list, with the line.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let in_text = |error: model_description::ReadError| error.to_string();
        let mut xml = Xml::new(bytes).map_err(in_text)?;
        let root = xml.root().map_err(in_text)?;
        if root.local() != "fmiReferences" {
            return Err(format!(
                "line {}: found <{}> at the root, allowed: <fmiReferences>",
                root.line, root.name
            ));
        }
        let mut manifest = Self::default();
        while let Some(child) = xml.child(&root).map_err(in_text)? {
            if child.local() == "Related" {
                manifest.related.push(related(&mut xml, &child)?);
            } else {
                xml.skip(&child).map_err(in_text)?;
            }
        }
        xml.finish().map_err(in_text)?;
        Ok(manifest)
    }

    /// The text of the file.
    pub fn to_xml(&self) -> String {
        let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <fmiReferences\n    xmlns:fmi-ls=\"http://fmi-standard.org/fmi-ls-manifest\"\n    \
             fmi-ls:fmi-ls-name=\"org.fmi-standard.fmi-ls-ref\"\n    fmi-ls:fmi-ls-version=\"1.0.0-beta.1\"\n    \
             fmi-ls:fmi-ls-description=\"Layered Standard providing information on related files included in an FMU.\">\n"
            .to_owned();
        for related in &self.related {
            let [kind, source, role, description] =
                [&related.kind, &related.source, &related.role, &related.description].map(|it| escape(it));
            let _ = write!(
                text,
                "  <Related type=\"{kind}\" source=\"{source}\" role=\"{role}\" description=\"{description}\""
            );
            let Some(flight) = &related.flight else {
                text.push_str("/>\n");
                continue;
            };
            let inputs =
                flight.inputs.as_ref().map_or(String::new(), |it| format!(" inputs=\"{}\"", escape(it)));
            let _ = write!(
                text,
                ">\n    <Annotations>\n      <Annotation type=\"{ANNOTATION}\">\n        \
                 <flight tolerance=\"{:e}\"{inputs}/>\n      </Annotation>\n    </Annotations>\n  </Related>\n",
                flight.tolerance
            );
        }
        text.push_str("</fmiReferences>\n");
        text
    }
}

fn related(xml: &mut Xml<'_>, start: &Start) -> Result<Related, String> {
    let text = |name: &str| start.attribute(name).unwrap_or_default().to_owned();
    let source = start
        .attribute("source")
        .ok_or_else(|| format!("line {}: <Related> has no source", start.line))?
        .to_owned();
    Ok(Related {
        kind: text("type"),
        source,
        role: text("role"),
        description: text("description"),
        flight: flight(xml, start)?,
    })
}

/// Our annotation somewhere inside an element.
fn flight(xml: &mut Xml<'_>, start: &Start) -> Result<Option<ReferenceSimulation>, String> {
    let mut found = None;
    while let Some(child) = xml.child(start).map_err(|error| error.to_string())? {
        let is_foreign = child.local() == "Annotation" && child.attribute("type") != Some(ANNOTATION);
        if is_foreign {
            xml.skip(&child).map_err(|error| error.to_string())?;
            continue;
        }
        if child.local() == "flight" {
            found = Some(terms(&child)?);
        }
        found = flight(xml, &child)?.or(found);
    }
    Ok(found)
}

fn terms(start: &Start) -> Result<ReferenceSimulation, String> {
    let text = start.attribute("tolerance").unwrap_or_default();
    let tolerance = text.parse().ok().filter(|it: &f64| it.is_finite() && *it >= 0.0).ok_or_else(|| {
        format!("line {}: found tolerance {text:?}, allowed: a number from 0 up", start.line)
    })?;
    Ok(ReferenceSimulation { tolerance, inputs: start.attribute("inputs").map(str::to_owned) })
}

#[cfg(test)]
mod tests {
    //! Lists are read as they were written; those of others too.

    use super::*;

    #[test]
    fn a_list_reads_back() {
        let result = Related {
            kind: "text/csv".to_owned(),
            source: "My_out.csv".to_owned(),
            role: "result".to_owned(),
            description: "a < b & \"c\"".to_owned(),
            flight: Some(ReferenceSimulation { tolerance: 1e-9, inputs: Some("My_in.csv".to_owned()) }),
        };
        let plain = Related { flight: None, ..result.clone() };
        let manifest = Manifest { related: vec![plain, result] };
        assert_eq!(Manifest::read(manifest.to_xml().as_bytes()), Ok(manifest));
    }

    #[test]
    fn annotations_of_others_are_left_alone() {
        let text = r#"<fmiReferences><Related source="a.csv" role="result"><Label name="x"/><Annotations>
            <Annotation type="com.example"><flight tolerance="none"/></Annotation></Annotations></Related>
            <Annotations/></fmiReferences>"#;
        let manifest = Manifest::read(text.as_bytes()).unwrap();
        assert_eq!(manifest.related.len(), 1);
        assert_eq!(manifest.related[0].flight, None);
    }

    #[test]
    fn what_is_no_list_is_named() {
        for (text, part) in [
            ("<fmiReferences>", "ends inside"),
            ("<other/>", "fmiReferences"),
            ("<fmiReferences><Related role=\"result\"/></fmiReferences>", "source"),
            (
                "<fmiReferences><Related source=\"a\"><Annotations><Annotation type=\"io.github.heliotorque\"><flight \
                 tolerance=\"-1\"/></Annotation></Annotations></Related></fmiReferences>",
                "tolerance \"-1\"",
            ),
        ] {
            let refusal = Manifest::read(text.as_bytes()).unwrap_err();
            assert!(refusal.contains(part), "{text}: {refusal}");
        }
    }
}
