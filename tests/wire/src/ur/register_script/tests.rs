//! Tests of the script of a public client, through its input and output registers.

use super::*;

fn inputs(command: i32, is_asynchronous: i32, numbers: &[f64]) -> Inputs {
    let mut inputs = Inputs::default();
    [inputs.integers[0], inputs.integers[1]] = [command, is_asynchronous];
    inputs.doubles[..numbers.len()].copy_from_slice(numbers);
    inputs
}

fn outputs(script: &RegisterScript) -> [i32; 3] {
    let first = script.first();
    [0, 1, 2].map(|at| script.output(first + at).expect("it writes three"))
}

#[test]
fn a_motion_is_executed_once_and_done_when_the_arm_rests() {
    let mut script = RegisterScript::begun(Setup::default());
    let to = inputs(3, 0, &[0.3, 0.0, 0.26, 3.1, 0.0, 0.0, 0.05]);
    let command = Command::read(&to, 0);
    assert_eq!(script.take(command, false), Some(command));
    assert_eq!(script.take(command, true), None, "it moves");
    assert_eq!(outputs(&script)[0], 1);
    script.rest();
    assert_eq!(outputs(&script)[0], 2);
    assert_eq!(script.take(command, false), None, "it is done");
    assert_eq!(script.take(Command::None, false), None);
    assert_eq!(outputs(&script)[0], 1);
    assert_eq!(script.take(command, false), Some(command), "it is new");
}

#[test]
fn a_motion_that_is_not_waited_for_is_reported_until_it_ends() {
    let mut script = RegisterScript::begun(Setup::default());
    assert_eq!(outputs(&script)[2], 0x0001_0000);
    let to = inputs(3, 1, &[0.3, 0.0, 0.26, 3.1, 0.0, 0.0, 0.05]);
    assert!(script.take(Command::read(&to, 0), false).is_some());
    assert_eq!(outputs(&script), [2, 0, 0x0102_8000]);
    script.take(Command::None, true);
    let question = Command::read(&inputs(47, 1, &[]), 0);
    assert!(script.take(question, true).is_some());
    assert_eq!(outputs(&script)[1], 0, "it moves");
    script.take(Command::None, true);
    assert_eq!(script.take(Command::Stop, true), Some(Command::Stop));
    assert_eq!(outputs(&script)[2], 0x0103_0000);
    script.take(Command::None, false);
    assert!(script.take(question, false).is_some());
    assert_eq!(outputs(&script)[1], 1, "it rests");
}

#[test]
fn a_command_without_an_emulation_or_without_numbers_ends_the_script() {
    let turning = inputs(10, 0, &[0.0, 0.0, 0.0, 0.1]);
    let endless = inputs(3, 0, &[f64::NAN]);
    for inputs in [inputs(6, 0, &[]), inputs(255, 0, &[]), turning, endless] {
        assert_eq!(Command::read(&inputs, 0), Command::End);
    }
    let down = inputs(10, 0, &[0.0, 0.0, -0.005]);
    let expected = Command::Cruise {
        velocity_m_s: [0.0, 0.0, -0.005],
    };
    assert_eq!(Command::read(&down, 0), expected);
}

#[test]
fn a_path_is_done_when_its_last_motion_is_and_its_motions_are_reported() {
    let waypoint = |height_m: f64| Waypoint {
        pose: [0.3, 0.0, height_m, 3.1, 0.0, 0.0],
        speed_m_s: 0.05,
    };
    let path = vec![waypoint(0.26), waypoint(0.27)];
    let setup = Setup { first: 0, path };
    let mut script = RegisterScript::begun(setup.clone());
    let command = Command::read(&inputs(45, 0, &[]), 0);
    assert_eq!(script.take(command, false), Some(command));
    assert_eq!(script.rest(), Some(waypoint(0.26)));
    assert_eq!(script.rest(), Some(waypoint(0.27)));
    assert_eq!(outputs(&script)[0], 1, "it moves");
    assert_eq!(script.rest(), None);
    assert_eq!(outputs(&script)[0], 2);

    let mut script = RegisterScript::begun(setup);
    let command = Command::read(&inputs(45, 1, &[]), 0);
    assert_eq!(script.take(command, false), Some(command));
    assert_eq!(outputs(&script)[0], 2, "nobody waits for it");
    script.rest();
    assert_eq!(outputs(&script)[2], 0x0203_8000);
    script.rest();
    assert_eq!(outputs(&script)[2], 0x0204_8001);
    assert_eq!(script.rest(), None);
    assert_eq!(outputs(&script)[2], 0x0205_0000);
    script.take(Command::None, false);
    assert_eq!(script.take(command, false), Some(command));
    script.take(Command::None, true);
    assert_eq!(script.take(Command::Stop, true), Some(Command::Stop));
    assert_eq!(script.rest(), None, "it was stopped");
}

#[test]
fn a_script_of_the_upper_registers_reads_and_writes_those_alone() {
    let text = "def rtde_control():\n    global reg_offset_float = # float register offset\n24    global reg_offset_int = # int register offset\n24    global x = 0\n";
    let mut script = RegisterScript::begun(Setup::of(text));
    assert_eq!(script.first(), 24);
    let mut both = inputs(255, 0, &[]);
    both.integers[24] = 47;
    let command = Command::read(&both, script.first());
    assert_eq!(command, Command::IsSteady);
    assert_eq!(script.take(command, false), Some(command));
    let written = [0, 24, 25, 27].map(|number| script.output(number));
    assert_eq!(written, [None, Some(2), Some(1), None]);
    assert_eq!(Setup::of(&text.replace("24", "0")).first, 0);
}

#[test]
fn a_followed_target_is_replaced_by_the_next_one_and_reached_within_the_time_that_is_allowed() {
    let mut script = RegisterScript::begun(Setup::default());
    for (asked_s, within_s) in [(0.1, 0.1), (0.0, 0.03), (5.0, 0.2)] {
        let target = [0.3, 0.0, 0.26, 3.1, 0.0, 0.0, 0.0, 0.0, 0.008, asked_s];
        let command = Command::read(&inputs(24, 0, &target), 0);
        let pose = [0.3, 0.0, 0.26, 3.1, 0.0, 0.0];
        assert_eq!(command, Command::Servo { pose, within_s });
        assert_eq!(script.take(command, true), Some(command));
        assert_eq!(outputs(&script)[0], 1, "it is ready for the next");
    }
    let stop = Command::read(&inputs(16, 0, &[]), 0);
    assert_eq!(script.take(stop, true), Some(Command::Stop));
}
