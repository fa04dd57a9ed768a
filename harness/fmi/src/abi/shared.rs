//! Memory that two processes share, as words that are read and written one at a time.

use std::{fs::File, io, ops::Deref, sync::atomic::AtomicU64};

use memmap2::{MmapOptions, MmapRaw};

/// Words shared with every process that maps the same file. Each is atomic, so whatever the other process does to
/// them, a read gives some number.
#[derive(Debug)]
pub struct SharedWords {
    mapping: MmapRaw,
    count: usize,
}

impl SharedWords {
    /// Creates an unnamed file of `count` words, all zero, and its mapping.
    pub fn create(count: usize) -> io::Result<(File, Self)> {
        #[cfg(target_os = "linux")]
        let file = {
            use rustix::fs::{MemfdFlags, memfd_create};
            File::from(memfd_create("heliotorque", MemfdFlags::CLOEXEC)?)
        };
        #[cfg(not(target_os = "linux"))]
        let file = tempfile::tempfile()?;
        file.set_len((count * size_of::<AtomicU64>()) as u64)?;
        let words = Self::map(&file)?;
        Ok((file, words))
    }

    /// Maps all of a file that [`SharedWords::create`] made, perhaps in another process. A process that this one
    /// forks does not have it.
    pub fn map(file: &File) -> io::Result<Self> {
        let bytes = usize::try_from(file.metadata()?.len()).map_err(io::Error::other)?;
        if bytes == 0 || !bytes.is_multiple_of(size_of::<AtomicU64>()) {
            return Err(io::Error::other("this file holds no shared words"));
        }
        let mapping = MmapOptions::new().len(bytes).map_raw(file)?;
        #[cfg(target_os = "linux")]
        mapping.advise(memmap2::Advice::DontFork)?;
        Ok(Self { mapping, count: bytes / size_of::<AtomicU64>() })
    }
}

impl Deref for SharedWords {
    type Target = [AtomicU64];

    fn deref(&self) -> &[AtomicU64] {
        // SAFETY: the mapping is of this length, begins at a page, is valid as long as `self` and is never made shorter
        // by us; any bits are a valid word, and all processes use atomic operations only.
        unsafe { std::slice::from_raw_parts(self.mapping.as_ptr().cast(), self.count) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::Ordering::Relaxed;

    #[test]
    fn two_mappings_are_one_memory() {
        let (file, one) = SharedWords::create(1000).unwrap();
        let two = SharedWords::map(&file).unwrap();
        assert_eq!((one.len(), two.len()), (1000, 1000));
        one[999].store(7, Relaxed);
        assert_eq!((two[999].load(Relaxed), two[0].load(Relaxed)), (7, 0));
        drop(one);
        assert_eq!(two[999].load(Relaxed), 7);
    }
}
