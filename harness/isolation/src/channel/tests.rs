//! Frames arrive whole and in order; nothing else is taken for one.

use super::*;

fn pair() -> (Link, Inbox) {
    let (file, inbox) = Inbox::create(None, None).unwrap();
    let words: &'static SharedWords = Box::leak(Box::new(SharedWords::map(&file).unwrap()));
    let token = words[TOKEN].swap(0, Ordering::Relaxed);
    (Link { words, token, head: 0, frame: Vec::new() }, inbox)
}

#[test]
fn frames_longer_than_the_ring_arrive_whole_and_in_order() {
    let (mut link, mut inbox) = pair();
    let sent: Vec<Vec<u64>> =
        [0, 1, RING_WORDS - 3, MAX_WORDS, 7].map(|length| (0..length as u64).collect()).to_vec();
    let expected = sent.clone();
    let child = std::thread::spawn(move || {
        for (kind, payload) in (0..).zip(sent) {
            link.send(kind, |frame| frame.extend(payload)).unwrap();
        }
    });
    let mut found = Vec::new();
    while found.len() < expected.len() {
        let mut take = |kind: u8, mut payload: Payload<'_>| {
            assert_eq!(usize::from(kind), found.len());
            let mut words = Vec::new();
            while let Some(word) = payload.word() {
                words.push(word);
            }
            found.push(words);
            Ok(())
        };
        inbox.drain(&mut take).unwrap();
    }
    child.join().unwrap();
    assert!(found == expected);
}

#[test]
fn texts_are_read_back_and_no_further_than_they_go() {
    let mut words = Vec::new();
    for text in ["", "eight by", "Überraum λ 火星"] {
        push_text(&mut words, text);
    }
    let mut payload = Payload(&words);
    for text in ["", "eight by", "Überraum λ 火星"] {
        assert_eq!(payload.text().as_deref(), Some(text));
    }
    assert!(payload.is_empty() && payload.text().is_none());
    assert_eq!(Payload(&[u64::MAX, 1]).text(), None);
    assert_eq!(Payload(&[9, 1]).text(), None);
}

#[test]
fn what_an_fmu_writes_into_the_memory_is_no_frame() {
    let mut take = |_: u8, _: Payload<'_>| -> Result<(), String> { panic!("taken") };
    let (mut link, mut inbox) = pair();
    link.token ^= 1;
    link.send(1, |_| {}).unwrap();
    assert!(inbox.drain(&mut take).is_err(), "a wrong token");
    let (link, mut inbox) = pair();
    link.words[HEAD].store(u64::MAX / 2, Ordering::Relaxed);
    assert!(inbox.drain(&mut take).is_err(), "a head beyond the ring");
    let (mut link, mut inbox) = pair();
    link.send(1, |_| {}).unwrap();
    link.words[RING].store(u64::MAX, Ordering::Relaxed);
    assert!(inbox.drain(&mut take).is_err(), "a length beyond all measure");
}
