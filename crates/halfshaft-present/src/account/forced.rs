//! What is told of linear vibration over the speed.

use halfshaft_results::{EngineOrders, ForcedGear, ForcedPeak, ForcedResult};

use super::campbell::gear_name;
use super::{Account, Grid};
use crate::words::{RPM, counted, number, plain, quantity};

/// Rows of a table at most.
const MOST_ROWS: usize = 30;

/// The whole account.
pub(crate) fn account(result: &ForcedResult) -> Account {
    let mut account = Account::default();
    account.text(opening(result));
    if result.gears.len() > 1 {
        account.grid(by_gear(result));
    }
    for (index, gear) in result.gears.iter().enumerate() {
        if result.gears.len() > 1 {
            account.heading(gear_name(&gear.gear));
        }
        for id in crate::figures::forced::ids(gear, index) {
            account.figure(id);
        }
        account.grid(peaks(gear, "N·m", "Largest torques"));
        account.grid(peaks(gear, "rad/s²", "Largest accelerations"));
        account.grid(heat(gear));
    }
    result.engines.iter().for_each(|engine| account.grid(engine_orders(engine)));
    account
}

/// The largest torque of one gear.
fn strongest(gear: &ForcedGear) -> Option<&ForcedPeak> {
    let torques = gear.peaks.iter().filter(|peak| peak.unit == "N·m");
    torques.max_by(|a, b| a.amplitude.total_cmp(&b.amplitude))
}

fn owner(peak: &ForcedPeak) -> String {
    plain(peak.channel.rsplit_once('.').map_or(peak.channel.as_str(), |(owner, _)| owner))
}

fn opening(result: &ForcedResult) -> Vec<String> {
    let orders: Vec<String> =
        result.orders.iter().take(12).map(|order| number(*order, 4)).collect();
    let more = if result.orders.len() > 12 { " and so on" } else { "" };
    let told = if result.orders.len() == 1 { "order" } else { "orders" };
    let mut sentences = vec![format!("Vibration by {told} {}{more}.", orders.join(", "))];
    let peaks = result.gears.iter().filter_map(strongest);
    if let Some(peak) = peaks.max_by(|a, b| a.amplitude.total_cmp(&b.amplitude)) {
        let by = if result.orders.len() > 1 {
            format!(
                ", of which order {} has {}",
                number(peak.order, 4),
                quantity(peak.order_amplitude, 4, "N·m")
            )
        } else {
            String::new()
        };
        sentences.push(format!(
            "The largest vibratory torque is ±{} in the {} at {} rpm{}{by}.",
            quantity(peak.amplitude, 4, "N·m"),
            owner(peak),
            number(peak.speed * RPM, 4),
            at_the_end(result, peak),
        ));
    }
    if result.gears.len() > 1 {
        sentences.push(format!("Told for {}.", counted(result.gears.len(), "gear", "gears")));
    }
    sentences
}

/// Says that a peak is none, but where the speeds end.
fn at_the_end(result: &ForcedResult, peak: &ForcedPeak) -> &'static str {
    let ends = result.gears.iter().flat_map(|gear| {
        let speeds = gear.table.values("frequency");
        [speeds.first().copied(), speeds.last().copied()]
    });
    let end = ends.flatten().any(|end| end == peak.speed);
    if end { " (an end of the range)" } else { "" }
}

fn by_gear(result: &ForcedResult) -> Grid {
    let rows: Vec<(&ForcedGear, Option<&ForcedPeak>)> =
        result.gears.iter().map(|gear| (gear, strongest(gear))).collect();
    Grid::new("Gear by gear: largest vibratory torque")
        .words("gear", rows.iter().map(|(gear, _)| gear_name(&gear.gear)))
        .numbers("torque ±", "N·m", 5, rows.iter().map(|(_, peak)| peak.map(|p| p.amplitude)))
        .words("in", rows.iter().map(|(_, peak)| peak.map_or_else(String::new, owner)))
        .numbers("at", "rpm", 5, rows.iter().map(|(_, peak)| peak.map(|p| p.speed * RPM)))
        .numbers("mostly order", "", 4, rows.iter().map(|(_, peak)| peak.map(|p| p.order)))
}

fn peaks(gear: &ForcedGear, unit: &str, title: &str) -> Grid {
    let mut rows: Vec<&ForcedPeak> = gear.peaks.iter().filter(|peak| peak.unit == unit).collect();
    rows.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let of = if rows.len() > MOST_ROWS {
        format!(", the first {MOST_ROWS} of {}", rows.len())
    } else {
        String::new()
    };
    rows.truncate(MOST_ROWS);
    Grid::new(format!("{title}{of}"))
        .words("of", rows.iter().map(|peak| owner(peak)))
        .numbers("half range", unit, 5, rows.iter().map(|peak| Some(peak.amplitude)))
        .numbers("at", "rpm", 5, rows.iter().map(|peak| Some(peak.speed * RPM)))
        .numbers("mostly order", "", 4, rows.iter().map(|peak| Some(peak.order)))
        .numbers("which has", unit, 5, rows.iter().map(|peak| Some(peak.order_amplitude)))
}

fn heat(gear: &ForcedGear) -> Grid {
    let mut rows: Vec<_> = gear.heat.iter().collect();
    rows.sort_by(|a, b| b.power.total_cmp(&a.power));
    rows.truncate(MOST_ROWS);
    Grid::new("Heat in dampers, where most")
        .words("in", rows.iter().map(|heat| plain(&heat.name)))
        .numbers("power", "W", 4, rows.iter().map(|heat| Some(heat.power)))
        .numbers("at", "rpm", 5, rows.iter().map(|heat| Some(heat.speed * RPM)))
}

fn engine_orders(engine: &EngineOrders) -> Grid {
    let column = |name: &str| engine.table.values(name).to_vec();
    let mut grid = Grid::new(format!("Orders of one cylinder of {}", plain(&engine.engine)))
        .numbers("order", "", 4, column("order").into_iter().map(Some));
    for (name, title, unit) in [("gas", "gas torque", "N·m"), ("mass", "masses at 1000 rpm", "N·m")]
    {
        let values = column(name);
        if !values.is_empty() {
            grid = grid.numbers(title, unit, 4, values.into_iter().map(Some));
            let phase = column(&format!("{name}.phase")).into_iter();
            grid = grid.fixed("phase", "°", 1, phase.map(|phase| Some(phase.to_degrees())));
        }
    }
    grid
}
