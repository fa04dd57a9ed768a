//! Frames arrive whole and in order; nothing else is taken for one.

use std::{borrow::Cow, ffi::OsString};

use super::*;

fn pair() -> (Link, Inbox) {
    let (file, inbox) = Inbox::create(Request::Command(Vec::new()), ResourceLimits::default()).unwrap();
    let words: &'static SharedWords = Box::leak(Box::new(SharedWords::map(&file).unwrap()));
    let token = words[TOKEN].swap(0, Ordering::Relaxed);
    (Link { words, token, head: 0, bytes: Vec::new(), screen: Screen::default() }, inbox)
}

#[test]
fn frames_longer_than_the_ring_arrive_whole_and_in_order() {
    let (mut link, mut inbox) = pair();
    let longest = MAX_BYTES / WORD - 1;
    let sent =
        [0, 1, RING_WORDS - 3, longest, 7].map(|length| (0..length).map(|it| it as f64).collect::<Vec<_>>());
    let expected = sent.clone();
    let child = std::thread::spawn(move || {
        for numbers in sent {
            link.send(&Frame::Numbers(Cow::from(&numbers))).unwrap();
        }
        let beyond = vec![0.0; longest + 1];
        assert!(link.send(&Frame::Numbers(Cow::from(&beyond))).is_err(), "longer than allowed");
    });
    let mut found = Vec::new();
    while found.len() < expected.len() {
        let mut take = |frame: Frame<'_>| {
            let Frame::Numbers(numbers) = frame else { panic!("{frame:?}") };
            found.push(numbers.into_owned());
            Ok(())
        };
        inbox.drain(&mut take).unwrap();
    }
    child.join().unwrap();
    assert!(found == expected);
}

#[test]
fn texts_arrive_as_they_are() {
    let (mut link, mut inbox) = pair();
    let texts = ["", "eight by", "Überraum λ 火星"];
    for text in texts {
        link.send(&Frame::Message(3, Some(text), text)).unwrap();
    }
    let mut found = Vec::new();
    let mut take = |frame: Frame<'_>| {
        let Frame::Message(3, Some(category), text) = frame else { panic!("{frame:?}") };
        found.push([category, text].map(str::to_owned));
        Ok(())
    };
    inbox.drain(&mut take).unwrap();
    assert_eq!(found, texts.map(|text| [text.to_owned(), text.to_owned()]));
}

#[test]
fn requests_longer_than_the_memory_are_refused() {
    let create = |length: usize| {
        let arguments = vec![OsString::from("x".repeat(length))];
        Inbox::create(Request::Command(arguments), ResourceLimits::default())
    };
    assert!(create(RING_WORDS * WORD - 100).is_ok());
    let error = create(RING_WORDS * WORD).err().unwrap();
    assert!(error.to_string().contains("too long"), "{error}");
}

#[test]
fn what_an_fmu_writes_into_the_memory_is_no_frame() {
    let mut take = |_: Frame<'_>| -> Result<(), String> { panic!("taken") };
    let (mut link, mut inbox) = pair();
    link.token ^= 1;
    link.send(&Frame::Done(files::outcome::Answer::Yes)).unwrap();
    assert!(inbox.drain(&mut take).is_err(), "a wrong token");
    let (link, mut inbox) = pair();
    link.words[HEAD].store(u64::MAX / 2, Ordering::Relaxed);
    assert!(inbox.drain(&mut take).is_err(), "a head beyond the ring");
    let (mut link, mut inbox) = pair();
    link.send(&Frame::Note("x")).unwrap();
    link.words[RING].store(u64::MAX, Ordering::Relaxed);
    assert!(inbox.drain(&mut take).is_err(), "a length beyond all measure");
}

/// Whatever stands in a frame with a right head, its content is a frame or an error that says so, and no memory is reserved beyond it.
#[test]
fn a_frame_whose_content_lies_is_refused() {
    let numbers = postcard::to_stdvec(&Frame::Numbers(Cow::from(vec![1.0; 4]))).unwrap();
    let with_length = |length: &[u8]| [&numbers[..1], length, &numbers[2..]].concat();
    let cases = [
        numbers[..numbers.len() - 1].to_vec(),
        [&numbers[..], &[0]].concat(),
        with_length(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f]),
        with_length(&[5]),
        vec![0xff; 64],
        Vec::new(),
        // A text that is no UTF-8.
        vec![1, 1, 0xff],
    ];
    for content in cases {
        let (mut link, mut inbox) = pair();
        link.send(&Frame::Output(&vec![0; content.len()])).unwrap();
        let padded = content.iter().copied().chain([0; WORD]).collect::<Vec<u8>>();
        for (word, value) in link.words[RING + FRAME_HEAD..].iter().zip(padded.as_chunks::<WORD>().0) {
            word.store(u64::from_le_bytes(*value), Ordering::Relaxed);
        }
        link.words[RING].store(content.len() as u64, Ordering::Relaxed);
        let end = FRAME_HEAD + content.len().div_ceil(WORD);
        link.words[HEAD].store(end as u64, Ordering::Release);
        let taken = inbox.drain(&mut |frame| panic!("{content:?} taken for {frame:?}"));
        assert_eq!(taken, Err(NOT_REQUESTED.to_owned()), "{content:?}");
    }
}
