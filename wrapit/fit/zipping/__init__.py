"""Lines that run along one another without room between them become one."""
