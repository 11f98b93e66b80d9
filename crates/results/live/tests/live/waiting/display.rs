//! Tests of the content of the page and of questions. Slow clients delay neither.

use std::time::{Duration, Instant};

use taceva_core::{Frame, FrameInfo, Newton, PixelFormat, Wrench};
use taceva_live::{Limits, Overlay, PageOperator, PredictedFrames, PredictedValue};
use taceva_protocol::{Answer, Cancel, Operator, Question};

use super::support::{Opened, frame, status, until};

#[test]
fn events_say_what_is_known_ten_times_a_second() {
    let opened = Opened::new();
    let mut events = opened.stream("/events");
    opened.live.limits(Limits::none().with_forces(2.0, 1.0));
    let wrench = Wrench {
        force: [Newton(0.3), Newton(0.4), Newton(1.25)],
        ..Wrench::default()
    };
    opened.live.force(&wrench);
    opened.live.lost(3, 1, true);
    let said = until(&mut events, "\"Fz_N\":1.25");
    let said = said + &until(&mut events, "\"dropped\":3");
    assert!(said.contains("\"Fxy_N\":0.5"), "{said}");
    assert!(said.contains("\"Fz_max_N\":2.0"), "{said}");
    let began = Instant::now();
    let mut count = 0;
    while began.elapsed() < Duration::from_secs(2) {
        until(&mut events, "event: state");
        count += 1;
    }
    assert!((5..=25).contains(&count), "{count} in two seconds");
    opened.live.ended("the run is finished");
    drop(opened.page);
    until(&mut events, "the run is finished");
}

#[test]
fn pictures_come_as_jpeg_and_the_newest_first() {
    let opened = Opened::new();
    let mut frames = opened.stream("/frames");
    let live = opened.live.clone();
    std::thread::spawn(move || {
        for level in 0..200 {
            live.frame(&frame(level, 32));
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    let said = until(&mut frames, "image/jpeg");
    assert!(said.contains("--taceva-picture"), "{said}");
    let answer = opened.asked("POST /stop", &opened.own(), "");
    assert_eq!(status(&answer), "204", "a stream is in nobody's way");
}

#[test]
fn who_comes_late_sees_the_last_frame() {
    let opened = Opened::new();
    opened.live.frame(&frame(90, 16));
    let mut frames = opened.stream("/frames");
    until(&mut frames, "image/jpeg");
}

#[test]
fn a_slow_browser_and_one_that_vanished_delay_nobody() {
    let opened = Opened::new();
    // A client that reads nothing, and a closed client.
    let slow = opened.stream("/frames");
    drop(opened.stream("/frames"));
    let noisy = {
        let mut state = 1_u32;
        let pixels = (0..640 * 480).map(|_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state.to_le_bytes()[3]
        });
        let info = FrameInfo {
            width: 640,
            height: 480,
            format: PixelFormat::Gray8,
        };
        Frame::new(info, pixels.collect()).expect("whole")
    };
    let mut longest = Duration::ZERO;
    let began = Instant::now();
    while began.elapsed() < Duration::from_secs(4) {
        let at = Instant::now();
        opened.live.frame(&noisy);
        longest = longest.max(at.elapsed());
        std::thread::sleep(Duration::from_millis(10));
    }
    // Time for a copy of a frame, with a margin for a busy machine.
    assert!(longest < Duration::from_millis(500), "{longest:?}");
    let answer = opened.asked("POST /stop", &opened.own(), "");
    assert_eq!(status(&answer), "204");
    drop(slow);
}

#[test]
fn the_page_answers_whoever_asks_and_stop_answers_for_it() {
    let opened = Opened::new();
    let mut operator = PageOperator::new(opened.live.clone());
    let mut events = opened.stream("/events");
    let cancel = Cancel::new();
    let answers = std::thread::scope(|scope| {
        let asking = scope.spawn(|| {
            [1, 2].map(|number| operator.ask(&Question::Unit(number.to_string()), &cancel))
        });
        until(&mut events, "put unit 1 in place");
        let body = "{\"question\": 1, \"answer\": \"skip\"}";
        assert_eq!(
            status(&opened.asked("POST /answer", &opened.own(), body)),
            "204"
        );
        until(&mut events, "put unit 2 in place");
        // Pressed twice: the second press does not answer the next question.
        assert_eq!(
            status(&opened.asked("POST /answer", &opened.own(), body)),
            "409"
        );
        assert_eq!(
            status(&opened.asked("POST /stop", &opened.own(), "")),
            "204"
        );
        asking.join().expect("no panic")
    });
    assert_eq!(answers, [Answer::Skip, Answer::Stop]);
}

#[test]
fn a_prediction_stands_in_the_head_of_its_picture_and_is_sent_once_however_many_look() {
    let opened = Opened::new();
    let (sender, sent) = std::sync::mpsc::channel();
    opened.live.on_sent(move |stamp_s| {
        let _ = sender.send(stamp_s);
    });
    opened.live.predictor("ridge sha256:0123 (m.taceva)");
    opened
        .live
        .predicted_frames(PredictedFrames::new(30, 2, Some(3)));
    let mut events = opened.stream("/events");
    let said = until(
        &mut events,
        "\"predicted\":{\"seen\":30,\"dropped\":2,\"outside\":3}",
    );
    assert!(
        said.contains("\"predicted_by\":\"ridge sha256:0123 (m.taceva)\""),
        "{said}"
    );
    let mut looking = [opened.stream("/frames"), opened.stream("/frames")];
    let values = vec![
        PredictedValue::new("Fz", 1.25, "N"),
        PredictedValue::new("Pz", 0.4, "mm"),
    ];
    let overlay = Overlay::new(7.5, values).with_distance(1.75, true);
    opened.live.predicted(&frame(90, 16), overlay);
    for stream in &mut looking {
        let head = until(stream, "\r\n\r\n");
        let head = match head.contains("X-Taceva-Prediction") {
            true => head,
            false => until(stream, "X-Taceva-Prediction") + &until(stream, "\r\n\r\n"),
        };
        let expected = "X-Taceva-Prediction: {\"t_s\":7.5,\"values\":[{\"channel\":\"Fz\",\"value\":1.25,\"unit\":\"N\"},{\"channel\":\"Pz\",\"value\":0.4,\"unit\":\"mm\"}],\"distance\":1.75,\"outside\":true}\r\n";
        assert!(head.contains(expected), "{head}");
    }
    assert_eq!(sent.recv_timeout(Duration::from_secs(5)), Ok(7.5));
    assert!(
        sent.recv_timeout(Duration::from_millis(300)).is_err(),
        "once"
    );
    // A picture without predictions has no prediction header.
    std::thread::sleep(Duration::from_millis(100));
    opened.live.frame(&frame(91, 16));
    let head = until(&mut looking[0], "image/jpeg");
    let head = head + &until(&mut looking[0], "\r\n\r\n");
    assert!(!head.contains("X-Taceva-Prediction"), "{head}");
}
