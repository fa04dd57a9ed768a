//! An SPK file: its segments in the order of the file, each with the body it places, from where, and when.
//!
//! What can be wrong with a file as a whole is found when it is opened (NAIF, DAF Required Reading): another kind of file, a
//! chain of summary records that breaks off or closes, a segment that ends behind the end of the file.

use std::path::Path;

use anise::{
    math::Vector3,
    naif::{
        SPK,
        daf::{
            DafDataType, NAIFDataSet, NAIFSummaryRecord,
            datatypes::{
                HermiteSetType12, HermiteSetType13, LagrangeSetType8, LagrangeSetType9, Type2ChebyshevSet,
                Type3ChebyshevSet, modified_diff::ModifiedDiffType1,
            },
        },
        spk::summary::SPKSummaryRecord,
    },
};
use fmi::Error;
use physics::environment::CartesianState;

use super::naif;

/// Length of a record, in bytes.
const RECORD: usize = 1024;
/// Length of a number, in bytes.
const NUMBER: usize = 8;
/// Offset in the file record of the number of the first summary record.
const FIRST_SUMMARIES: usize = 76;
/// Offset in the file record of the order of bytes, and this machine's order.
const BYTE_ORDER: usize = 88;
const NATIVE: &[u8] = if cfg!(target_endian = "little") { b"LTL-IEEE" } else { b"BIG-IEEE" };
/// The frame J2000, the mean equator and equinox of that epoch: EME2000.
const J2000_FRAME: i32 = 1;
/// m in a km.
const KM_M: f64 = 1000.0;

/// An open file.
pub(super) struct SpkFile {
    /// Its name without folders.
    pub name: String,
    spk: SPK,
    /// In the order of the file.
    pub segments: Vec<Segment>,
}

/// A segment: one body over a span of time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    summary: SPKSummaryRecord,
    block: Option<usize>,
    place: usize,
}

impl Segment {
    /// The body that it places.
    pub(super) fn target(&self) -> i32 {
        self.summary.target_id
    }

    /// From where its positions count.
    pub(super) fn center(&self) -> i32 {
        self.summary.center_id
    }

    /// First and last epoch, in s past J2000 TDB.
    pub(super) fn span_s(&self) -> [f64; 2] {
        [self.summary.start_epoch_et_s, self.summary.end_epoch_et_s]
    }
}

impl SpkFile {
    /// Opens a file.
    ///
    /// # Errors
    ///
    /// No file, no SPK, a torn one; with the path.
    pub(super) fn open(path: &Path) -> Result<Self, String> {
        let in_file = |what: String| format!("{}: {what}", path.display());
        let bytes = files::read(path).map_err(|error| in_file(error.to_string()))?;
        check_kind(&bytes).and_then(|()| check_chain(&bytes)).map_err(in_file)?;
        let torn = |what: &dyn std::error::Error| in_file(format!("torn or damaged: {}", Error::chain(what)));
        let spk = SPK::parse(&bytes[..]).map_err(|error| torn(&error))?;
        let mut segments = Vec::new();
        let mut block = None;
        loop {
            let record = spk.daf_summary(block).map_err(|error| torn(&error))?;
            let summaries = spk.data_summaries(block).map_err(|error| torn(&error))?;
            for (place, summary) in summaries.iter().take(record.num_summaries()).enumerate() {
                let end = summary.end_index().saturating_mul(NUMBER);
                if summary.start_idx < 1 || summary.end_idx < summary.start_idx || end > bytes.len() {
                    return Err(in_file(format!(
                        "torn or damaged: the segment of {} ends at byte {end} of {}",
                        naif::named(summary.target_id),
                        bytes.len()
                    )));
                }
                segments.push(Segment { summary: *summary, block, place });
            }
            if record.is_final_record() {
                break;
            }
            block = Some(record.next_record());
        }
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        Ok(Self { name, spk, segments })
    }

    /// The state of a segment's target from its center, in EME2000.
    ///
    /// # Errors
    ///
    /// A frame or a type of data that is not read, data that make no sense.
    pub(super) fn state(&self, segment: &Segment, at_s: f64) -> Result<CartesianState, String> {
        let Segment { summary, .. } = segment;
        let refuse = |what: String| format!("{}: {}: {what}", self.name, naif::named(summary.target_id));
        if summary.frame_id != J2000_FRAME {
            return Err(refuse(format!("found frame {}, allowed: {J2000_FRAME}, J2000", summary.frame_id)));
        }
        use DafDataType as Type;
        let (position_km, velocity_km_s) = match summary.data_type() {
            Ok(Type::Type1ModifiedDifferenceArray) => self.evaluated::<ModifiedDiffType1>(segment, at_s),
            Ok(Type::Type2ChebyshevTriplet) => self.evaluated::<Type2ChebyshevSet>(segment, at_s),
            Ok(Type::Type3ChebyshevSextuplet) => self.evaluated::<Type3ChebyshevSet>(segment, at_s),
            Ok(Type::Type8LagrangeEqualStep) => self.evaluated::<LagrangeSetType8>(segment, at_s),
            Ok(Type::Type9LagrangeUnequalStep) => self.evaluated::<LagrangeSetType9>(segment, at_s),
            Ok(Type::Type12HermiteEqualStep) => self.evaluated::<HermiteSetType12>(segment, at_s),
            Ok(Type::Type13HermiteUnequalStep) => self.evaluated::<HermiteSetType13>(segment, at_s),
            _ => {
                let found = summary.data_type_i;
                Err(format!("found data type {found}, allowed: 1, 2, 3, 8, 9, 12, 13"))
            }
        }
        .map_err(refuse)?;
        Ok(CartesianState { position_m: position_km * KM_M, velocity_m_s: velocity_km_s * KM_M })
    }

    fn evaluated<'a, S: NAIFDataSet<'a, StateKind = (Vector3, Vector3)>>(
        &'a self,
        segment: &Segment,
        at_s: f64,
    ) -> Result<(Vector3, Vector3), String> {
        let data =
            self.spk.nth_data::<S>(segment.block, segment.place).map_err(|error| Error::chain(&error))?;
        let found = data.evaluate(at_s, &segment.summary).map_err(|error| Error::chain(&error))?;
        let is_finite = found.0.iter().chain(found.1.iter()).all(|value| value.is_finite());
        is_finite.then_some(found).ok_or_else(|| "damaged: a state that is not finite".to_owned())
    }
}

/// Refuses what is no SPK file of this machine's order of bytes.
fn check_kind(bytes: &[u8]) -> Result<(), String> {
    if !bytes.starts_with(b"DAF/SPK ") {
        let found = match bytes.get(..NUMBER) {
            Some(word) if word.starts_with(b"DAF/") => String::from_utf8_lossy(word).trim_end().to_owned(),
            _ => "another kind of file".to_owned(),
        };
        return Err(format!("found {found}, allowed: an SPK kernel of SPICE (DAF/SPK)"));
    }
    match bytes.get(BYTE_ORDER..BYTE_ORDER + NUMBER) {
        Some(order) if order == NATIVE => Ok(()),
        Some(order @ (b"LTL-IEEE" | b"BIG-IEEE")) => Err(format!(
            "found the order of bytes {}, allowed: {}, into which NAIF's bingo converts",
            String::from_utf8_lossy(order),
            String::from_utf8_lossy(NATIVE)
        )),
        _ => Err("torn or damaged: the file record says no order of bytes".to_owned()),
    }
}

/// Follows the summary records from the first to the last.
fn check_chain(bytes: &[u8]) -> Result<(), String> {
    let first: Option<[u8; 4]> = bytes.get(FIRST_SUMMARIES..).and_then(|rest| rest.first_chunk()).copied();
    let mut record = first.map_or(0, u32::from_ne_bytes) as usize;
    for _ in 0..=bytes.len() / RECORD {
        let start = record.checked_sub(1).map(|before| before.saturating_mul(RECORD));
        let whole = start.and_then(|start| bytes.get(start..start.saturating_add(RECORD)));
        let Some(next) = whole.and_then(|whole| whole.first_chunk()).copied().map(f64::from_ne_bytes) else {
            return Err(format!(
                "torn or damaged: it has no record {record}, where segments should be listed"
            ));
        };
        if next == 0.0 {
            return Ok(());
        }
        record = next as usize;
    }
    Err("damaged: the list of its segments has no end".to_owned())
}
