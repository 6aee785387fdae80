"""What a picture shows around the drawing: table, shadow, a scan's dark edges, punched holes, frames."""
