//! What happened at the connections of a line: contacts, stages, stick and slip, listed and counted.

use halfshaft_dynamics::{EquationsOfMotion, EventKind, ModeEvent, Motion};
use halfshaft_results::{ConnectionEvents, HistoryEvent, Named};

/// Events that are listed at most; all are counted.
const MOST_LISTED: usize = 10_000;

/// The events of a run.
#[derive(Clone, Debug)]
pub(crate) struct Events {
    pub(crate) listed: Vec<HistoryEvent>,
    /// Events in the recorded time, listed or not.
    pub(crate) count: usize,
    connections: Vec<Connection>,
    record: (f64, f64),
}

/// What is known of one connection.
#[derive(Clone, Debug)]
struct Connection {
    name: String,
    is_gear: bool,
    counted: ConnectionEvents,
    /// Whether it is in free play, and whether it sticks, since when.
    free: bool,
    stuck: bool,
    since: f64,
    free_time: f64,
    stuck_time: f64,
    /// Side last touched.
    side: Option<bool>,
    /// Whether anything of it ever switches.
    switches: bool,
}

impl Events {
    /// No events yet of a motion that begins at time zero.
    pub(super) fn new(
        equations: &EquationsOfMotion,
        motion: &Motion<'_>,
        record: (f64, f64),
    ) -> Self {
        let shafts = equations.network.ends.len() - equations.meshes;
        let connection =
            |(index, connection): (usize, &halfshaft_dynamics::Connection)| Connection {
                name: connection.name.clone(),
                is_gear: index >= shafts,
                counted: ConnectionEvents::default(),
                free: motion.is_free(index),
                stuck: motion.is_stuck(index),
                since: 0.0,
                free_time: 0.0,
                stuck_time: 0.0,
                side: None,
                switches: motion.modes().is_some()
                    && (connection.friction.is_some() || connection.law.pieces().list().len() > 1),
            };
        let connections = equations.connections.iter().enumerate().map(connection).collect();
        Self { listed: Vec::new(), count: 0, connections, record }
    }

    /// Takes an event; `motion` is in the modes after it.
    pub(super) fn take(&mut self, time: f64, event: &ModeEvent, motion: &Motion<'_>) {
        self.pass_time(time, motion);
        let (from, to) = self.record;
        if event.kind == EventKind::Point || time < from || time > to {
            return;
        }
        self.count += 1;
        let connection = &mut self.connections[event.connection];
        connection.count(event);
        if self.listed.len() < MOST_LISTED {
            self.listed.push(connection.told(time, event));
        }
    }

    /// Adds up how long connections have been free or stuck until a time.
    pub(super) fn pass_time(&mut self, time: f64, motion: &Motion<'_>) {
        let (from, to) = self.record;
        for (index, connection) in self.connections.iter_mut().enumerate() {
            let passed = (time.min(to) - connection.since.max(from)).max(0.0);
            connection.free_time += if connection.free { passed } else { 0.0 };
            connection.stuck_time += if connection.stuck { passed } else { 0.0 };
            connection.since = time;
            connection.free = motion.is_free(index);
            connection.stuck = motion.is_stuck(index);
        }
    }

    /// What was counted at each connection that switches, over the recorded time until `end`.
    pub(crate) fn summary(&self, end: f64) -> Named<ConnectionEvents> {
        let recorded = (end.min(self.record.1) - self.record.0).max(f64::MIN_POSITIVE);
        let of = |connection: &Connection| {
            let counted = ConnectionEvents {
                free_share: connection.free_time / recorded,
                stuck_share: connection.stuck_time / recorded,
                ..connection.counted.clone()
            };
            (connection.name.clone(), counted)
        };
        self.connections.iter().filter(|connection| connection.switches).map(of).collect()
    }
}

impl Connection {
    fn count(&mut self, event: &ModeEvent) {
        let counted = &mut self.counted;
        match event.kind {
            EventKind::Contact { drive } => {
                counted.contacts += 1;
                counted.lash_crossings += u64::from(self.side.is_some_and(|side| side != drive));
                self.side = Some(drive);
                counted.hardest_impact_speed = counted.hardest_impact_speed.max(event.rate.abs());
                counted.hardest_impact_energy = counted.hardest_impact_energy.max(event.energy);
                counted.impact_energy += event.energy;
            }
            EventKind::Separation { drive } => {
                counted.separations += 1;
                self.side = Some(drive);
            }
            EventKind::Stage { .. } => counted.stage_changes += 1,
            EventKind::Stick => counted.sticks += 1,
            EventKind::Slip { .. } => counted.slips += 1,
            EventKind::Point => {}
        }
    }

    fn told(&self, time: f64, event: &ModeEvent) -> HistoryEvent {
        let side = |drive: bool| if drive { "drive side" } else { "coast side" };
        let (kind, what) = match event.kind {
            EventKind::Contact { drive } => ("contact", format!("contact on the {}", side(drive))),
            EventKind::Separation { drive } => {
                ("separation", format!("contact lost on the {}", side(drive)))
            }
            EventKind::Stage { number } => ("stage", format!("stage {number} by twist begins")),
            EventKind::Stick => ("stick", "dry friction sticks".to_owned()),
            EventKind::Slip { forward: true } => ("slip", "slides forwards".to_owned()),
            EventKind::Slip { forward: false } => ("slip", "slides backwards".to_owned()),
            EventKind::Point => ("point", "a point of the measured law".to_owned()),
        };
        let element = if self.is_gear { "gear" } else { "shaft" };
        let impact = matches!(event.kind, EventKind::Contact { .. });
        HistoryEvent {
            time,
            element: self.name.clone(),
            kind: kind.to_owned(),
            text: format!("{element} \"{}\": {what}", self.name),
            twist: event.twist,
            twist_rate: event.rate,
            energy: impact.then_some(event.energy),
        }
    }
}
