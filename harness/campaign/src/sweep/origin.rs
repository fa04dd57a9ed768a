//! Origin of a table of runs, as TOML beside it, and the digests by which a sweep is taken up again.

use std::{fs, io, ops::Range, path::Path};

use inputs::{
    campaign::file::CampaignFile,
    epoch::{self, is_epoch},
};
use tables::output::{EPOCH_KEY, set_identity, set_times};
use toml_edit::{DocumentMut, Item, Table};
use uuid::Uuid;

use super::{resolved::Campaign, started::Started};

/// Names of digests are in a name space of their own.
const NAME_SPACE: Uuid = Uuid::from_u128(0x8e5d_3f0a_71c4_4b52_9d26_c0f1_6a4e_92b7);
const HEAD: &str =
    "# The table beside this file, as `heliotorque sweep` wrote it: values and columns in SI.\n";

/// Digests of what a table comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Digests {
    /// Digest of the campaign, its mission and their tables.
    pub campaign: String,
    /// Digest of all files of the FMU.
    pub fmu: String,
    /// The runs that the table has.
    pub runs: Range<u64>,
}

impl Digests {
    /// # Errors
    /// A file that cannot be read.
    pub(super) fn new(
        file: &CampaignFile,
        campaign: &Campaign,
        folder: &Path,
        runs: &Range<u64>,
    ) -> Result<Self, String> {
        let read = |path: &Path| files::read(path).map_err(|error| format!("{}: {error}", path.display()));
        let mut bytes = file.text.clone().into_bytes();
        if let Some(mission) = &campaign.simulated.mission {
            bytes.extend(read(&mission.file)?);
        }
        for table in campaign.simulated.run.input.iter().chain(&file.table) {
            bytes.extend(read(table)?);
        }
        let mut all = Vec::new();
        gather(folder, folder, &mut all).map_err(|error| format!("{}: {error}", folder.display()))?;
        let digest = |bytes: &[u8]| Uuid::new_v5(&NAME_SPACE, bytes).to_string();
        Ok(Self { campaign: digest(&bytes), fmu: digest(&all), runs: runs.clone() })
    }

    /// Reads the digests from the text beside a table.
    pub(super) fn read(text: &str) -> Option<Self> {
        let document: DocumentMut = text.parse().ok()?;
        let digest = |key: &str| Some(document.get("digests")?.get(key)?.as_str()?.to_owned());
        let whole = |key: &str| u64::try_from(document.get(key)?.as_integer()?).ok();
        let first = whole("first_run")?;
        let runs = first..first.checked_add(whole("runs")?)?;
        Some(Self { campaign: digest("campaign")?, fmu: digest("fmu")?, runs })
    }

    /// Refuses what stands beside a table of something else.
    ///
    /// # Errors
    /// Compares with the digests in a file; the error says found and allowed.
    pub(super) fn check(&self, beside: &Path) -> Result<(), String> {
        let refuse = |found: &str, allowed: &str| {
            let anew = "with --fresh it begins anew";
            Err(format!("{}: found {found}, allowed: {allowed}: {anew}", beside.display()))
        };
        let ours = "those of this campaign and FMU";
        match files::read_text(beside).ok().and_then(|text| Self::read(&text)) {
            None => refuse("no digests", ours),
            Some(found) if found.campaign != self.campaign => refuse("another campaign", ours),
            Some(found) if found.fmu != self.fmu => refuse("another FMU", ours),
            Some(Self { runs, .. }) if runs != self.runs => {
                let range = |runs: &Range<u64>| format!("{}..{}", runs.start, runs.end);
                refuse(
                    &format!("the runs {}", range(&runs)),
                    &format!("those of this sweep, {}", range(&self.runs)),
                )
            }
            Some(_) => Ok(()),
        }
    }
}

/// Names and bytes of all files in a folder, in the order of their names.
fn gather(root: &Path, folder: &Path, bytes: &mut Vec<u8>) -> io::Result<()> {
    let mut paths: Vec<_> =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    paths.sort();
    for path in paths {
        if path.is_dir() {
            gather(root, &path, bytes)?;
        } else {
            let name = path.strip_prefix(root).unwrap_or(&path);
            bytes.extend(name.as_os_str().as_encoded_bytes());
            bytes.extend(files::read(&path)?);
        }
    }
    Ok(())
}

/// The text beside a table: units, seed, versions, digests.
pub(super) fn to_toml(started: &Started<'_>, digests: &Digests) -> String {
    let Started { file, campaign, described, .. } = *started;
    let runs = &digests.runs;
    let mut document = DocumentMut::new();
    let mut set = |key: &str, item: Item| drop(document.insert(key, item));
    set("program", toml_edit::value(concat!("heliotorque", " ", env!("CARGO_PKG_VERSION"))));
    set("campaign", toml_edit::value(file.file.display().to_string()));
    set("simulated", toml_edit::value(file.simulated().display().to_string()));
    set_times(&mut document, campaign.settings.times);
    let mut set = |key: &str, item: Item| drop(document.insert(key, item));
    let whole = |number: u64| toml_edit::value(i64::try_from(number).unwrap_or(i64::MAX));
    set("first_run", whole(runs.start));
    set("runs", whole(runs.end - runs.start));
    set("seed", whole(file.seed));
    set("sampling", toml_edit::value(campaign.design.sampling().key()));
    let mut fmu = Table::new();
    set_identity(&mut fmu, described);
    // Runs that start at different epochs have no common dates.
    let varied = campaign.design.varied();
    let is_varied = |name: &str| varied.iter().any(|it| it.name == name);
    let is_dated = described.variables.iter().all(|it| !is_varied(&it.name) || !is_epoch(it));
    let epoch_s = epoch::zero_epoch_s(described, &campaign.settings.sets, 0.0).filter(|_| is_dated);
    if let Some(epoch_s) = epoch_s {
        fmu.insert(EPOCH_KEY, toml_edit::value(epoch_s));
    }
    set("fmu", Item::Table(fmu));
    let mut table = Table::new();
    table.insert("campaign", toml_edit::value(&digests.campaign));
    table.insert("fmu", toml_edit::value(&digests.fmu));
    set("digests", Item::Table(table));
    let mut vary = Table::new();
    // By the names of the columns; a table of values has no other origin.
    for (at, varied) in file.distributions().zip(campaign.design.varied()) {
        let text = format!("{} {}", at.it.key, at.it.values.join(", "));
        vary.insert(&varied.name, toml_edit::value(text));
    }
    set("vary", Item::Table(vary));
    let mut units = Table::new();
    let unit = |position: usize| fmi::unit(described, &described.variables[position]).unwrap_or("");
    for position in &campaign.varied {
        units.insert(&described.variables[*position].name, toml_edit::value(unit(*position)));
    }
    for (name, column) in campaign.kept.columns(described) {
        let unit = if name.ends_with(".timeOfLargest") { "s" } else { unit(campaign.kept.positions[column]) };
        units.insert(&name, toml_edit::value(unit));
    }
    set("units", Item::Table(units));
    format!("{HEAD}{document}")
}
